#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/rng.h"
#include "sensor/flicker_design.h"

namespace thermal {

/// 1/f noise of every pixel over time: the processes of a design, without its white part. A frame is a function of
/// (seed, clip, frame) and of the last restart alone, whichever frames are requested. It is stationary from the first
/// frame on. Blocks of pixels tick at random phases, so that all frames cost the same.
class FlickerNoise {
 public:
  static constexpr std::size_t kBlockPixels = 256;

  FlickerNoise(std::uint32_t seed, std::string_view clip, const FlickerDesign& design, std::size_t pixels);

  /// Restarts at a frame, independent of all before it: as after a shutter closing, which measures and removes each
  /// pixel's accumulated offset. `event` numbers the closing; each has its own random numbers. Event 0 begins at frame
  /// 0 without a call.
  void restart_at(std::uint32_t frame, std::uint32_t event);

  /// Advances pixels [first, first + out.size()) to a frame and adds `stddev` times the noise. `first` is a multiple of
  /// kBlockPixels. Frame numbers must not decrease; gaps cost their ticks alone. Safe to call from several threads on
  /// different pixels.
  void add(std::uint32_t frame, std::size_t first, float stddev, std::span<float> out);

 private:
  [[nodiscard]] float* state(std::size_t block, std::size_t process) noexcept;
  void start(std::size_t block);
  void sum_slow(std::size_t block);
  void tick(std::size_t block, std::uint64_t tick);
  void advance(std::size_t block, std::uint32_t frame);

  RandomField field_;
  FlickerDesign design_;
  std::uint64_t period_ = 1;  ///< of the fastest process
  std::uint32_t begins_ = 0;
  std::uint32_t event_ = 0;
  std::vector<std::uint32_t> phases_;  ///< by block: native frames from a tick of all processes to frame 0
  std::vector<std::uint64_t> ticks_;   ///< by block: last tick of the fastest process, or none
  std::vector<float> states_;          ///< by block, process and pixel
  std::vector<float> slow_;            ///< by pixel: sum of all processes but the fastest
  std::vector<float> sums_;  ///< by pixel: sum of all processes, which add() adds until the next tick
};

}  // namespace thermal
