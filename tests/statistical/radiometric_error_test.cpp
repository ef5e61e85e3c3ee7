#include <cmath>
#include <string>

#include "sensor/shutter.h"
#include "support/catch.h"
#include "support/statistics.h"

namespace radiometric_error_test {

using namespace thermal;
using statistics::kSigmas;

TEST_CASE("The stated accuracy is two standard deviations of a clip's error, and eight of its drift") {
  constexpr int kClips = 20000;
  double squares = 0;
  double drift_squares = 0;
  double mean = 0;
  for (int clip = 0; clip < kClips; ++clip) {
    const RadiometricError error(4, 1, "clip" + std::to_string(clip));
    const double start_k = error.at_k({.event = 1});
    const double drift_k = error.at_k({.event = 1, .since_intervals = 1}) - start_k;
    mean += start_k / kClips;
    squares += start_k * start_k / kClips;
    drift_squares += drift_k * drift_k / kClips;
  }
  const double scatter = kSigmas * std::sqrt(2.0 / kClips);
  CHECK_THAT(mean, WithinAbs(0, kSigmas * 2 / std::sqrt(kClips)));
  CHECK_THAT(squares, WithinRel(4.0, scatter));
  CHECK_THAT(drift_squares, WithinRel(0.25, scatter));
}

}  // namespace radiometric_error_test
