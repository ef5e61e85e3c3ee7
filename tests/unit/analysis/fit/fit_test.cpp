#include "analysis/fit/fit.h"

#include "base/error.h"
#include "support/catch.h"
#include "support/grey_frames.h"
#include "support/message_of.h"

namespace fit_test {

using namespace thermal;
using grey_frames::white;

namespace {

/// Frames of noise, each a unit.
std::vector<FrameFigures> frames_of(double level, double deviation, std::uint32_t first) {
  std::vector<FrameFigures> frames;
  for (std::uint32_t k = 0; k < 12; ++k) {
    frames.push_back(measure_frame(white(96, 80, level, deviation, first + k), {}));
    frames.back().unit = k;
  }
  return frames;
}

}  // namespace

TEST_CASE("The distance of frames grows with what differs, and is smallest for frames alike") {
  const RealFeatures real(frames_of(100, 4, 0), 1);
  const double alike = real.distance(frames_of(100, 4, 100));
  const double near = real.distance(frames_of(100, 4.5, 100));
  const double far = real.distance(frames_of(100, 8, 100));
  CHECK(alike < 1);  // about ln 2: as far as halves are from each other
  CHECK(alike < near);
  CHECK(near < far);
  CHECK(real.distance(real.frames()) == 0);
}

TEST_CASE("Too little is asked for") {
  const auto message_with = [](auto change) {
    FitOptions options{.assets = Assets(Path())};
    change(options);
    return message_of<ConfigError>([&] { options.validate(); });
  };
  CHECK(message_with([](FitOptions& options) { options.clips = 1; }) == "--clips = 1; expected at least 2");
  CHECK(message_with([](FitOptions& options) { options.most_frames = 7; }) ==
        "--frames = 7; expected at least 8");
  CHECK(message_with([](FitOptions& options) { options.trials = 19; }) ==
        "--trials = 19; expected at least 20");
}

}  // namespace fit_test
