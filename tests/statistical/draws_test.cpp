#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "io/config/distribution.h"
#include "support/catch.h"
#include "support/statistics.h"

namespace statistical_draws_test {

using namespace thermal;
using statistics::kSigmas;

namespace {

constexpr int kDraws = 20000;
const Json kNumber = {{"type", "number"}};

Json drawn(const char* distribution, const Json& rules, int clip,
           const std::string& path = "weather.wind_m_s") {
  std::vector<std::string> faults;
  const DrawKey key = {.seed = 3, .owner = "clip_" + std::to_string(clip), .path = path};
  Json value = drawn_value(parse_json(distribution, ""), rules, key, path, faults);
  REQUIRE(faults.empty());
  return value;
}

std::vector<double> numbers(const char* distribution, const Json& rules,
                            const std::string& path = "weather.wind_m_s") {
  std::vector<double> values;
  for (int clip = 0; clip < kDraws; ++clip) values.push_back(drawn(distribution, rules, clip, path));
  return values;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double variance_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return sum / static_cast<double>(values.size());
}

/// The mean has a variance of variance / n, the variance one of (kurtosis - 1) variance^2 / n.
void check_moments(const std::vector<double>& values, double mean, double variance, double kurtosis) {
  const auto n = static_cast<double>(values.size());
  CHECK(std::abs(mean_of(values) - mean) < kSigmas * std::sqrt(variance / n));
  CHECK(std::abs(variance_of(values) - variance) < kSigmas * variance * std::sqrt((kurtosis - 1) / n));
}

}  // namespace

TEST_CASE("Uniform draws have the mean and variance of their range") {
  check_moments(numbers(R"({"uniform": [2, 8]})", kNumber), 5, 3, 1.8);
}

TEST_CASE("Whole numbers are drawn with both ends, all alike") {
  const std::vector<double> values = numbers(R"({"uniform": [1, 4]})", {{"type", "integer"}});
  std::map<double, int> counts;
  for (const double value : values) ++counts[value];
  REQUIRE(counts.size() == 4);
  for (const auto& [value, count] : counts)
    CHECK(std::abs(count - kDraws / 4.0) < kSigmas * std::sqrt(kDraws * 0.25 * 0.75));
}

TEST_CASE("Normal draws have their mean and variance") {
  check_moments(numbers(R"({"normal": [10, 2]})", kNumber), 10, 4, 3);
}

TEST_CASE("Normal draws below a key's range are drawn again") {
  // Half a normal distribution: mean sqrt(2 / pi), variance 1 - 2 / pi, kurtosis 3.869.
  const std::vector<double> values = numbers(R"({"normal": [0, 1]})", {{"type", "number"}, {"minimum", 0}});
  check_moments(values, std::sqrt(2 / M_PI), 1 - 2 / M_PI, 3.8692);
}

TEST_CASE("Choices follow their weights") {
  int second = 0;
  for (int clip = 0; clip < kDraws; ++clip)
    second +=
        drawn(R"({"choice": ["a", "b"], "weights": [3, 1]})", {{"type", "string"}}, clip) == "b" ? 1 : 0;
  CHECK(std::abs(second - kDraws / 4.0) < kSigmas * std::sqrt(kDraws * 0.25 * 0.75));
}

TEST_CASE("Times are drawn over midnight, each minute alike") {
  const Json rules = {{"type", "string"}, {"pattern", "^([01][0-9]|2[0-3]):[0-5][0-9]$"}};
  int before = 0;
  for (int clip = 0; clip < kDraws; ++clip) {
    const std::string time = drawn(R"({"uniform": ["18:00", "05:59"]})", rules, clip, "weather.time");
    CHECK((time >= "18:00" || time <= "05:59"));
    before += time >= "18:00" ? 1 : 0;
  }
  CHECK(std::abs(before - kDraws / 2.0) < kSigmas * std::sqrt(kDraws * 0.25));
}

TEST_CASE("Draws of two keys of a clip, and of one key of a choice, are independent") {
  const std::vector<double> wind = numbers(R"({"uniform": [-1, 1]})", kNumber);
  for (const std::vector<double>& other :
       {numbers(R"({"uniform": [-1, 1]})", kNumber, "weather.cloud_fraction"),
        numbers(R"({"choice": [{"uniform": [-1, 1]}]})", kNumber)}) {
    double product = 0;
    for (int k = 0; k < kDraws; ++k)
      product += wind[static_cast<std::size_t>(k)] * other[static_cast<std::size_t>(k)];
    CHECK(std::abs(product / kDraws) < kSigmas / 3 / std::sqrt(kDraws));  // each has a variance of 1 / 3
  }
}

}  // namespace statistical_draws_test
