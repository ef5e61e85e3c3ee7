#include <algorithm>
#include <cmath>
#include <utility>

#include "dataset/reports/labels.h"
#include "support/catch.h"

namespace histograms_test {

using namespace thermal;

namespace {

std::vector<HistogramValue> of_one_category(const std::vector<double>& values) {
  std::vector<HistogramValue> entries;
  for (const double value : values) entries.push_back({value, 0});
  return entries;
}

int sum_of(const Json& counts) {
  int sum = 0;
  for (const Json& count : counts) sum += count.get<int>();
  return sum;
}

}  // namespace

TEST_CASE("Bins have round widths and hold all values") {
  const std::vector<double> edges = bin_edges({60.2, 71, 96.8}, Bins::linear);
  REQUIRE(edges.size() == 20);  // 36.6 / 15 = 2.4: 2 wide, 60 to 98
  CHECK(edges.front() == 60);
  CHECK(edges.back() == 98);
}

TEST_CASE("Logarithmic bins are five per decade, aligned to decades") {
  const std::vector<double> edges = bin_edges({1, 99}, Bins::logarithmic);
  REQUIRE(edges.size() == 11);
  CHECK(edges[0] == 1);
  CHECK(std::abs(edges[5] - 10) < 1e-12);
  CHECK(std::abs(edges[10] - 100) < 1e-12);
}

TEST_CASE("Fractions have the same twenty bins for all values") {
  const std::vector<double> edges = bin_edges({0.5}, Bins::share);
  REQUIRE(edges.size() == 21);
  CHECK(edges.front() == 0);
  CHECK(edges.back() == 1);
}

TEST_CASE("A single value has a bin") {
  for (const double value : {0.0, 293.0, -4.5}) {
    const Json histogram = histogram_of(of_one_category({value}), 1, Bins::linear);
    CHECK(histogram.at("edges").size() >= 2);
    CHECK(sum_of(histogram.at("counts")[0]) == 1);
    CHECK(histogram.at("median") == value);
  }
}

TEST_CASE("Values on edges count for the bin they start, the last one for the last") {
  const Json histogram = histogram_of(of_one_category({0, 0.05, 0.999, 1}), 1, Bins::share);
  CHECK(histogram.at("counts")[0][0] == 1);
  CHECK(histogram.at("counts")[0][1] == 1);
  CHECK(histogram.at("counts")[0][19] == 2);
  CHECK(histogram.at("below") == 0);
  CHECK(histogram.at("above") == 0);
}

TEST_CASE("A far outlier does not stretch the axis, and is counted separately") {
  std::vector<double> values(999, 10.0);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] += 0.01 * static_cast<double>(k);
  values.push_back(1e6);
  const Json histogram = histogram_of(of_one_category(values), 1, Bins::linear);
  CHECK(histogram.at("edges").back() <= 21);
  CHECK(histogram.at("above") == 1);
  CHECK(histogram.at("most") == 1e6);
  CHECK(sum_of(histogram.at("counts")[0]) == 1000);
}

TEST_CASE("Values of any finite size have few bins") {
  for (const auto& [low, high] :
       {std::pair{1e17, 1e17 + 64}, {-1e308, 1e308}, {1e308, 1.01e308}, {0.0, 5e-324}}) {
    CAPTURE(low, high);
    const std::vector<double> edges = bin_edges({low, high}, Bins::linear);
    CHECK(edges.size() >= 2);
    CHECK(edges.size() <= 40);
    CHECK(std::ranges::is_sorted(edges));
    CHECK(edges.front() <= low);
    CHECK(edges.back() >= high);
  }
}

TEST_CASE("Labels without a value are counted and nothing else") {
  const Json histogram = histogram_of({{std::nullopt, 0}, {std::nullopt, 1}}, 2, Bins::linear);
  CHECK(histogram == Json{{"known", 0}, {"of", 2}});
}

TEST_CASE("Each category has its own counts") {
  const Json histogram = histogram_of({{0.1, 0}, {0.1, 1}, {0.9, 1}, {std::nullopt, 0}}, 3, Bins::share);
  CHECK(histogram.at("known") == 3);
  CHECK(sum_of(histogram.at("counts")[0]) == 1);
  CHECK(sum_of(histogram.at("counts")[1]) == 2);
  CHECK(sum_of(histogram.at("counts")[2]) == 0);
}

}  // namespace histograms_test
