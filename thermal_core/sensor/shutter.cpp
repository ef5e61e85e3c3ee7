#include "sensor/shutter.h"

#include <algorithm>

namespace thermal {

Shutter::Shutter(const ShutterParameters& parameters, std::uint32_t seed, std::string_view clip)
    : parameters_(parameters) {
  float phase = 0;
  fill_uniform({.seed = seed, .stream = kShutterPhaseStream, .clip = hash_name(clip), .frame = 0}, 0,
               std::span(&phase, 1));
  begins_s_ = static_cast<double>(phase) * parameters.interval_s;
}

ShutterState Shutter::at(double time_s) const noexcept {
  if (parameters_.interval_s <= 0) return {};
  const double elapsed_s = begins_s_ + time_s;
  const double event = std::floor(elapsed_s / parameters_.interval_s);
  const double since_s = std::max(0.0, elapsed_s - event * parameters_.interval_s);  // rounding: below 0
  return {.event = static_cast<std::uint32_t>(event),
          .since_intervals = since_s / parameters_.interval_s,
          .closed = since_s < parameters_.freeze_s};
}

std::uint32_t Shutter::first_frame(std::uint32_t event, double rate_hz) const noexcept {
  if (event == 0) return 0;
  const double begins = (event * parameters_.interval_s - begins_s_) * rate_hz;
  auto frame = static_cast<std::uint32_t>(std::max(0.0, std::ceil(begins)));
  // at() has the definition; rounding may differ by a frame.
  while (frame > 0 && at((frame - 1) / rate_hz).event >= event) --frame;
  while (at(frame / rate_hz).event < event) ++frame;
  return frame;
}

}  // namespace thermal
