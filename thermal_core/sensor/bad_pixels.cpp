#include "sensor/bad_pixels.h"

#include <algorithm>
#include <cmath>

#include "base/rng.h"
#include "sensor/streams.h"

namespace thermal {
namespace {

/// Pixels whose uniform number is below `share`.
std::vector<std::size_t> chosen(const RandomField& field, double share, std::size_t pixels) {
  std::vector<std::size_t> list;
  if (share <= 0) return list;
  std::vector<float> numbers(pixels);
  fill_uniform(field, 0, numbers);
  for (std::size_t i = 0; i < pixels; ++i) {
    if (static_cast<double>(numbers[i]) < share) list.push_back(i);
  }
  return list;
}

}  // namespace

BadPixels::BadPixels(const BadPixelParameters& parameters, std::uint32_t seed, std::string_view clip,
                     double frame_rate_hz, int width_px, int height_px)
    : parameters_(parameters), seed_(seed), clip_(hash_name(clip)) {
  // A telegraph signal that flips at a rate r is in the other state after t with probability (1 - e^{-2 r t}) / 2.
  flip_probability_ = static_cast<float>(-0.5 * std::expm1(-2 * parameters.blinking_hz / frame_rate_hz));
  const std::size_t pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  dead_ = chosen({.seed = seed, .stream = kDeadPixelStream, .clip = clip_, .frame = 0}, parameters.dead_share,
                 pixels);
  if (!dead_.empty()) is_dead_.resize(pixels);
  for (const std::size_t pixel : dead_) is_dead_[pixel] = true;
  blinking_ = chosen({.seed = seed, .stream = kBlinkingPixelStream, .clip = clip_, .frame = 0},
                     parameters.blinking_share, pixels);
  is_up_.resize(blinking_.size());
  if (parameters.late_dead_per_hour > 0) draw_late_dead(frame_rate_hz, pixels);
}

/// Lifetimes are exponential. The 24 bits of a uniform number are too few for early failures, so a second number
/// extends them.
void BadPixels::draw_late_dead(double frame_rate_hz, std::size_t pixels) {
  constexpr double kSecondsAnHour = 3600;
  std::vector<float> numbers(pixels);
  std::vector<float> finer(pixels);
  fill_uniform({.seed = seed_, .stream = kLateDeadStream, .clip = clip_, .frame = 0}, 0, numbers);
  fill_uniform({.seed = seed_, .stream = kLateDeadMomentStream, .clip = clip_, .frame = 0}, 0, finer);
  for (std::size_t i = 0; i < pixels; ++i) {
    const double number = static_cast<double>(numbers[i]) + 0x1p-24 * static_cast<double>(finer[i]);
    const double hours = -std::log1p(-number) / parameters_.late_dead_per_hour;
    if (hours < kLateDeadHours)
      late_dead_.push_back({.frame = hours * kSecondsAnHour * frame_rate_hz, .pixel = i});
  }
  std::ranges::stable_sort(late_dead_, {}, &LateDead::frame);
}

void BadPixels::apply(std::uint32_t frame, float noise_stddev, Plane<float>& signal) {
  if (!blinking_.empty()) {
    while (next_ <= frame) blink(next_++);
  }
  const float height = noise_stddev * static_cast<float>(parameters_.blinking_ratio);
  for (std::size_t i = 0; i < blinking_.size(); ++i) {
    if (is_up_[i]) signal.pixels()[blinking_[i]] += height;
  }
  for (const LateDead& late : late_dead_) {
    if (late.frame > frame) break;
    signal.pixels()[late.pixel] = 0;
  }
  std::vector<float> shown;  // all are computed before any is replaced; dead neighbours are left out
  for (const std::size_t pixel : dead_) {
    shown.push_back(parameters_.replace_dead ? living_mean(pixel, signal) : 0.0F);
  }
  for (std::size_t i = 0; i < dead_.size(); ++i) signal.pixels()[dead_[i]] = shown[i];
}

void BadPixels::blink(std::uint32_t frame) {
  std::vector<float> numbers(blinking_.size());
  fill_uniform({.seed = seed_, .stream = kBlinkStream, .clip = clip_, .frame = frame}, 0, numbers);
  const float probability = frame > 0 ? flip_probability_ : 0.5F;  // both states are equally likely at first
  for (std::size_t i = 0; i < blinking_.size(); ++i) {
    if (numbers[i] < probability) is_up_[i] = !is_up_[i];
  }
}

float BadPixels::living_mean(std::size_t pixel, const Plane<float>& signal) const {
  const auto width = static_cast<std::size_t>(signal.width_px());
  const auto x = static_cast<int>(pixel % width);
  const auto y = static_cast<int>(pixel / width);
  float sum = 0;
  int count = 0;
  for (int reach = 1; reach <= 2 && count == 0; ++reach) {  // sides first, then corners as well
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int steps = std::abs(dx) + std::abs(dy);
        const bool inside =
            x + dx >= 0 && x + dx < signal.width_px() && y + dy >= 0 && y + dy < signal.height_px();
        if (steps == 0 || steps > reach || !inside) continue;
        if (is_dead_[static_cast<std::size_t>(y + dy) * width + static_cast<std::size_t>(x + dx)]) continue;
        sum += signal.at(x + dx, y + dy);
        ++count;
      }
    }
  }
  return count == 0 ? 0.0F : sum / static_cast<float>(count);
}

}  // namespace thermal
