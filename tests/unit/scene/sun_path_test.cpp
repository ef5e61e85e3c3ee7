#include "scene/sun_path.h"

#include <cmath>
#include <numbers>

#include "support/catch.h"

namespace sun_path_test {

using Catch::Matchers::WithinAbs;

TEST_CASE("At noon the sun is as high as latitude and declination say") {
  // Declination of an almanac at the solstices: 23.44 deg. Spencer's series is within 0.0006 rad.
  const double degree = std::numbers::pi / 180;
  const auto june = thermal::sun_direction({.latitude_deg = -19, .day_of_year = 172}, 12);
  CHECK_THAT(june[0], WithinAbs(0, 1e-12));
  CHECK_THAT(std::atan2(june[2], june[1]), WithinAbs((90 - 19 - 23.44) * degree, 1e-3));
  const auto december = thermal::sun_direction({.latitude_deg = -19, .day_of_year = 356}, 12);
  CHECK_THAT(std::atan2(december[2], -december[1]), WithinAbs((90 - 4.44) * degree, 1e-3));
}

TEST_CASE("The sun rises in the east, and each hour has its middle") {
  const thermal::SunHours hours = thermal::sun_hours({.latitude_deg = 0, .day_of_year = 80});
  for (std::size_t k = 0; k < hours.size(); ++k) {
    const auto& [east, north, up] = hours[k];
    CHECK_THAT(std::hypot(east, north, up), WithinAbs(1, 1e-12));
    CHECK((up > 0) == (k >= 6 && k < 18));
    CHECK((east > 0) == (k < 12));
  }
  CHECK(hours[12] == thermal::sun_direction({.latitude_deg = 0, .day_of_year = 80}, 12.5));
}

}  // namespace sun_path_test
