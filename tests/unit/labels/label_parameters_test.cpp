#include <limits>

#include "base/error.h"
#include "labels/instances.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace label_parameters_test {

using namespace thermal;

namespace {

bool ignored(std::uint32_t area_px, std::optional<double> visibility, const LabelParameters& parameters) {
  Instance instance;
  instance.area_px = area_px;
  instance.visibility = visibility;
  return is_ignored(instance, parameters);
}

}  // namespace

TEST_CASE("By default nothing is ignored") {
  CHECK_FALSE(ignored(1, 0.001, {}));
  CHECK_FALSE(ignored(1, std::nullopt, {}));
}

TEST_CASE("A target below a threshold is ignored, one at it is not") {
  const LabelParameters parameters = {.ignore_below_visibility = 0.25, .ignore_below_area_px = 10};
  CHECK_FALSE(ignored(10, 0.25, parameters));
  CHECK(ignored(9, 1, parameters));
  CHECK(ignored(10, 0.24, parameters));
  CHECK_FALSE(ignored(10, std::nullopt, parameters));  // unknown values do not matter
  CHECK(ignored(9, std::nullopt, parameters));
}

TEST_CASE("Invalid thresholds are errors") {
  const auto fault_of = [](const LabelParameters& wrong) {
    return message_of<ConfigError>([&] { wrong.validate(); });
  };
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  CHECK(fault_of({.occluded_below_visibility = 1.5}) ==
        "labels.occluded_below_visibility = 1.5; expected 0 to 1");
  CHECK(fault_of({.ignore_below_visibility = kNaN}) ==
        "labels.ignore_below_visibility = nan; expected 0 to 1");
  CHECK(fault_of({.ignore_below_area_px = -1}) == "labels.ignore_below_area_px = -1 px; expected 0 or more");
  CHECK(fault_of({.ignore_below_area_px = std::numeric_limits<double>::infinity()}) ==
        "labels.ignore_below_area_px = inf px; expected 0 or more");
  CHECK_NOTHROW(LabelParameters({.occluded_below_visibility = 1, .ignore_below_visibility = 1}).validate());
}

}  // namespace label_parameters_test
