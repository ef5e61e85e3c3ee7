#include "analysis/fit/fitted_keys.h"

#include <algorithm>
#include <string_view>

#include "support/catch.h"

namespace fitted_keys_test {

using namespace thermal;

namespace {

std::size_t number_of(std::string_view path) {
  const auto found =
      std::ranges::find_if(fitted_keys(), [path](const auto& key) { return key.path == path; });
  REQUIRE(found != fitted_keys().end());
  return static_cast<std::size_t>(found - fitted_keys().begin());
}

/// A place that differs from the start in one key's coordinates.
std::vector<double> moved(const FittedSpace& space, std::string_view path, const std::vector<double>& to) {
  std::size_t first = 0;
  for (std::size_t k = 0; k < number_of(path); ++k) first += fitted_keys()[k].varies ? 2U : 1U;
  std::vector<double> place = space.start();
  std::ranges::copy(to, place.begin() + static_cast<std::ptrdiff_t>(first));
  return place;
}

const Json kResolved = {
    {"sensor",
     {{"noise", {{"amount", 1}}},
      {"optics", {{"aberration_sigma_px", 0.25}}},
      {"processing", {{"noise_filter_sigma_px", 0}, {"unsharp_amount", 0}, {"unsharp_sigma_px", 2}}},
      {"agc",
       {{"max_gain_dn_per_netd", 8}, {"tail_percent", 0.05}, {"black_level", 0}, {"white_level", 255}}}}}};

}  // namespace

TEST_CASE("The start is the config itself, whatever it leaves out or has beyond what is searched") {
  const Json document = {{"name", "x"}, {"sensor", {{"noise", {{"amount", 50}}}}}};
  const FittedSpace space(document, kResolved);
  CHECK(space.document_at(space.start()) == document);
  CHECK(space.value_at(number_of("/sensor/noise/amount"), space.start()) == 4);
}

TEST_CASE("Only keys that differ are changed, to a number or a distribution of three digits") {
  const FittedSpace space({{"name", "x"}}, kResolved);
  CHECK(space.document_at(moved(space, "/sensor/processing/unsharp_amount", {0.5, 0.5})) ==
        Json{{"name", "x"}, {"sensor", {{"processing", {{"unsharp_amount", 1.25}}}}}});
  CHECK(space.document_at(moved(space, "/sensor/processing/unsharp_amount", {0.6, 1.0 / 3})) ==
        Json{{"name", "x"}, {"sensor", {{"processing", {{"unsharp_amount", {{"uniform", {0.833, 1.5}}}}}}}}});
  const Json level =
      space.document_at(moved(space, "/sensor/agc/black_level", {0.21}))["sensor"]["agc"]["black_level"];
  CHECK(level.is_number_integer());
  CHECK(level == 13);
}

TEST_CASE("Distances of ratios are logarithmic, and distributions are read as their ends") {
  const Json document = {{"sensor", {{"noise", {{"amount", {{"uniform", {0.2, 0.8}}}}}}}}};
  const FittedSpace space(document, kResolved);
  const std::size_t noise = number_of("/sensor/noise/amount");
  CHECK(space.value_at(noise, space.start()) == Json{{"uniform", {0.2, 0.8}}});
  CHECK(space.value_at(noise, moved(space, "/sensor/noise/amount", {0.5, 0.5})) == 0.2);  // sqrt(0.01 x 4)
}

TEST_CASE("A key within a choice is set in each of its entries") {
  const Json document = {
      {"sensor",
       {{"agc", {{"choice", {{{"mode", "plateau"}}, {{"mode", "percentile"}}}}, {"weights", {4, 2}}}}}}};
  const FittedSpace space(document, kResolved);
  const Json agc = space.document_at(moved(space, "/sensor/agc/white_level", {1.0 / 3}))["sensor"]["agc"];
  CHECK(agc["choice"] ==
        Json{{{"mode", "plateau"}, {"white_level", 215}}, {{"mode", "percentile"}, {"white_level", 215}}});
  CHECK(agc["weights"] == Json{4, 2});
}

TEST_CASE("A stage is added to a share of the clips, and weights keep their ratios") {
  const FittedSpace without({{"name", "x"}}, kResolved);
  const Json link = without.document_at(moved(without, "/output/link", {0.25}))["output"]["link"];
  CHECK(link["weights"] == Json{0.75, 0.25});
  CHECK(link["choice"][0].is_null());
  CHECK(link["choice"][1]["standard"] == "pal");
  CHECK(link["choice"][1]["row_levels"] == 2);  // the middle: the config says nothing of it
  CHECK(without.document_at(moved(without, "/output/link", {1}))["output"]["link"]["standard"] == "pal");
  CHECK_FALSE(without.document_at(moved(without, "/output/link/row_levels", {0.9})).contains("output"));

  const Json two = {
      {"choice",
       {nullptr, {{"name", "h264"}, {"bitrate_kbit_s", 100}}, {{"name", "mjpeg"}, {"bitrate_kbit_s", 300}}}},
      {"weights", {1, 1, 3}}};
  const FittedSpace with({{"output", {{"codec", two}}}}, kResolved);
  CHECK(with.document_at(moved(with, "/output/codec", {0.4}))["output"]["codec"]["weights"] ==
        Json{0.6, 0.1, 0.3});
  const Json all = with.document_at(moved(with, "/output/codec", {1}))["output"]["codec"];
  CHECK(all["choice"].size() == 2);
  CHECK(all["choice"][0]["bitrate_kbit_s"] == 100);
  CHECK_FALSE(with.document_at(moved(with, "/output/codec", {0}))["output"].contains("codec"));
}

}  // namespace fitted_keys_test
