#include "radiometry/spectral_response.h"

#include <limits>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace spectral_response_test {

using namespace thermal;

namespace {

using Samples = std::vector<SpectralResponse::Sample>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string fault_in(const Samples& samples) {
  return message_of<ConfigError>([&] { (void)SpectralResponse(samples); });
}

}  // namespace

TEST_CASE("A response is scaled to a peak of 1") {
  const SpectralResponse response({{8, 2}, {10, 4}, {14, 1}});
  CHECK(response.samples()[0].response == 0.5);
  CHECK(response.samples()[1].response == 1);
  CHECK(response.samples()[2].response == 0.25);
  CHECK(response.begin_um() == 8);
  CHECK(response.end_um() == 14);
}

TEST_CASE("A flat response is 1 from end to end") {
  const SpectralResponse response = SpectralResponse::flat(7.5, 13.5);
  REQUIRE(response.samples().size() == 2);
  CHECK(response.begin_um() == 7.5);
  CHECK(response.end_um() == 13.5);
  CHECK(response.samples()[0].response == 1);
  CHECK(response.samples()[1].response == 1);
}

TEST_CASE("A response needs two samples") {
  CHECK(fault_in({}) == "response: samples = 0; expected at least 2");
  CHECK(fault_in({{10, 1}}) == "response: samples = 1; expected at least 2");
}

TEST_CASE("Wavelengths are ascending, positive and finite") {
  CHECK(fault_in({{8, 1}, {7, 1}}) == "response: wavelength 2 = 7 um; expected a finite number above 8 um");
  CHECK(fault_in({{8, 1}, {8, 1}}) == "response: wavelength 2 = 8 um; expected a finite number above 8 um");
  CHECK(fault_in({{0, 1}, {8, 1}}) == "response: wavelength 1 = 0 um; expected a finite number above 0 um");
  CHECK(fault_in({{-8, 1}, {8, 1}}) == "response: wavelength 1 = -8 um; expected a finite number above 0 um");
  CHECK(fault_in({{8, 1}, {kNaN, 1}}) ==
        "response: wavelength 2 = nan um; expected a finite number above 8 um");
  CHECK(fault_in({{8, 1}, {kInfinity, 1}}) ==
        "response: wavelength 2 = inf um; expected a finite number above 8 um");
}

TEST_CASE("Responses are finite and not negative") {
  CHECK(fault_in({{8, 1}, {9, -0.1}}) == "response at 9 um = -0.1; expected a finite number of at least 0");
  CHECK(fault_in({{8, kNaN}, {9, 1}}) == "response at 8 um = nan; expected a finite number of at least 0");
  CHECK(fault_in({{8, 1}, {9, kInfinity}}) ==
        "response at 9 um = inf; expected a finite number of at least 0");
}

TEST_CASE("A response of zero is an error") {
  CHECK(fault_in({{8, 0}, {14, 0}}) == "response: largest value = 0; expected more than 0");
}

}  // namespace spectral_response_test
