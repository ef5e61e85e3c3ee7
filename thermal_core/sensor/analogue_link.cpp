#include "sensor/analogue_link.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/clones.h"
#include "base/interpolation.h"
#include "base/parallel.h"
#include "sensor/optics/psf.h"
#include "sensor/streams.h"
#include "sensor/vector_math.h"

namespace thermal {
namespace {

constexpr std::size_t kLinesPerChunk = 16;
constexpr float kWhiteLevel = 255;

/// Standard deviation [px] of the Gaussian that attenuates amplitudes at the bandwidth to a half.
double bandwidth_sigma_px(const AnalogueLinkParameters& link, int width_px) {
  const double cycles_per_px = link.bandwidth_mhz * link.active_line_us / width_px;
  return std::sqrt(0.5 * std::numbers::ln2) / (std::numbers::pi * cycles_per_px);
}

/// A whole number of batches of random numbers for each line.
std::size_t random_line(int width_px) {
  return (static_cast<std::size_t>(width_px) + kRandomBatch - 1) / kRandomBatch * kRandomBatch;
}

/// Position of a row's centre among `others` rows of the same picture.
BetweenNodes between_rows(int row, int rows, int others) {
  return between_nodes((row + 0.5) * others / rows - 0.5, static_cast<std::size_t>(others));
}

VELDT_CLONES void add_weighted(const std::uint8_t* in, std::size_t count, float weight, float* out) {
  for (std::size_t i = 0; i < count; ++i)
    out[i] += weight * static_cast<float>(static_cast<std::int32_t>(in[i]));
}

VELDT_CLONES void round_levels(const float* in, std::size_t count, float brighter, std::uint8_t* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const float level = in[i] + (brighter + 0.5F);
    const float above = level > 0 ? level : 0;
    out[i] = static_cast<std::uint8_t>(static_cast<std::int32_t>(above < kWhiteLevel ? above : kWhiteLevel));
  }
}

/// out[i] lies between in[i] and in[i - 1].
VELDT_CLONES void mix_with_left(const float* in, std::size_t count, float share, float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = in[i] + share * (in[i - 1] - in[i]);
}

/// Shifts a line to the right. Beyond its ends, the end values are replicated.
void shift(double right_px, std::vector<float>& line) {
  if (right_px == 0) return;
  const auto width = static_cast<std::ptrdiff_t>(line.size());
  const double whole = std::floor(right_px);
  const auto part = static_cast<float>(right_px - whole);
  const std::ptrdiff_t right =
      std::clamp(static_cast<std::ptrdiff_t>(whole), -width, width);  // at most beyond the other end
  std::vector<float> longer(static_cast<std::size_t>(3 * width + 1));
  const auto begin = longer.begin() + width + 1;
  std::fill(longer.begin(), begin, line.front());
  std::copy(line.begin(), line.end(), begin);
  std::fill(begin + width, longer.end(), line.back());
  mix_with_left(&begin[-right], line.size(), part, line.data());
}

float level_between(const Plane<std::uint8_t>& picture, float x, float y) {
  const float left = std::clamp(x, 0.0F, static_cast<float>(picture.width_px() - 1));
  const float top = std::clamp(y, 0.0F, static_cast<float>(picture.height_px() - 1));
  const int x0 = static_cast<int>(left);
  const int y0 = static_cast<int>(top);
  const int x1 = std::min(x0 + 1, picture.width_px() - 1);
  const int y1 = std::min(y0 + 1, picture.height_px() - 1);
  const float across = left - static_cast<float>(x0);
  const float down = top - static_cast<float>(y0);
  const auto mixed = [across](std::uint8_t one, std::uint8_t other) {
    return static_cast<float>(one) + across * static_cast<float>(other - one);
  };
  const float above = mixed(picture.at(x0, y0), picture.at(x1, y0));
  const float below = mixed(picture.at(x0, y1), picture.at(x1, y1));
  return above + down * (below - above);
}

/// Number of events of a Poisson process with this mean, from a uniform number.
int poisson(double mean, double uniform) {
  double probability = std::exp(-mean);
  double sum = probability;
  int count = 0;
  while (uniform > sum && count < 10 * mean + 100) {
    probability *= mean / ++count;
    sum += probability;
  }
  return count;
}

/// Time at which a line's field is sent, relative to the frame's time, in fields.
double field_time(int line) { return line % 2 == 0 ? -0.5 : 0.5; }

}  // namespace

AnalogueLink::AnalogueLink(const AnalogueLinkParameters& parameters, const Clip& clip)
    : parameters_(parameters),
      seed_(clip.seed),
      clip_(hash_name(clip.id)),
      frame_rate_hz_(clip.frame_rate_hz),
      width_px_(clip.width_px),
      height_px_(clip.height_px),
      lines_(parameters.lines > 0 ? parameters.lines : clip.height_px),
      bandwidth_(gaussian_psf(bandwidth_sigma_px(parameters, clip.width_px))),
      noise_(noise_of(parameters, parameters.active_line_us / clip.width_px)),
      received_(clip.width_px, lines_) {
  assert(parameters.drift_rows > 0 && parameters.bandwidth_mhz > 0);
  float turns = 0;
  fill_uniform(field(kLinkHumStream, 0), 0, std::span(&turns, 1));
  hum_turns_ = static_cast<double>(turns);
}

/// White noise n plus an exponentially correlated s, s' = follows s + u, is an ARMA(1, 1) process: with one new random
/// number e a pixel, n + s = carried state + e, and the next state is follows (carried state) + carried e. Spectral
/// factorisation gives the variance of e, and the standard deviation of the initial state.
AnalogueLink::Noise AnalogueLink::noise_of(const AnalogueLinkParameters& link, double px_us) {
  const double step = px_us / link.streak_us;
  const double follows = std::exp(-step);
  const double forgotten = -std::expm1(-2 * step);  // 1 - follows^2
  const double white = link.noise_levels * link.noise_levels;
  const double driven = link.streak_levels * link.streak_levels * forgotten;
  if (driven <= 0) return {.fresh = static_cast<float>(link.noise_levels)};
  const auto spectrum = [&](double cosine_part) { return driven + white * cosine_part * cosine_part; };
  const double low = spectrum(-std::expm1(-step));  // at frequency 0 and at Nyquist, times (1 -+ follows)^2
  const double high = spectrum(1 + follows);
  const double moving = (std::sqrt(low) - std::sqrt(high)) / (std::sqrt(low) + std::sqrt(high));
  const double fresh = 0.5 * (std::sqrt(low) + std::sqrt(high));
  const double carried = follows + moving;
  return {.fresh = static_cast<float>(fresh),
          .carried = static_cast<float>(carried * fresh),
          .follows = static_cast<float>(follows),
          .first = static_cast<float>(carried * fresh / std::sqrt(forgotten))};
}

RandomField AnalogueLink::field(std::uint32_t stream, std::uint32_t frame) const noexcept {
  return {.seed = seed_, .stream = stream, .clip = clip_, .frame = frame};
}

/// A normally distributed number for each line.
std::vector<float> AnalogueLink::drawn(double deviation, std::uint32_t stream, std::uint32_t frame) const {
  if (deviation <= 0) return std::vector<float>(static_cast<std::size_t>(lines_));
  std::vector<float> values = normal_values(field(stream, frame), lines_);
  for (float& value : values) value *= static_cast<float>(deviation);
  return values;
}

void AnalogueLink::pass(const ImageMotion& motion, Plane<std::uint8_t>& picture) {
  if (motion.empty()) return pass(0.0F, picture);
  const double intervals = frame_rate_hz_ / parameters_.field_rate_hz;
  transmit(
      [&](int line, std::vector<float>& levels) {
        const BetweenNodes rows = between_rows(line, lines_, height_px_);
        const auto y = static_cast<float>(static_cast<double>(rows.low) + rows.share_of_high);
        const int nearest = static_cast<int>(rows.share_of_high < 0.5 ? rows.low : rows.high);
        const auto share = static_cast<float>(field_time(line) * intervals);
        for (int x = 0; x < width_px_; ++x) {
          const float right_px = share * motion.x_px.at(x, nearest);
          const float down_px = share * motion.y_px.at(x, nearest);
          levels[static_cast<std::size_t>(x)] =
              level_between(picture, static_cast<float>(x) - right_px, y - down_px);
        }
      },
      picture);
}

void AnalogueLink::pass(float field_motion_px, Plane<std::uint8_t>& picture) {
  transmit(
      [&](int line, std::vector<float>& levels) {
        const BetweenNodes rows = between_rows(line, lines_, height_px_);
        const auto share = static_cast<float>(rows.share_of_high);
        add_weighted(picture.row(static_cast<int>(rows.low)).data(), levels.size(), 1 - share, levels.data());
        if (share > 0)
          add_weighted(picture.row(static_cast<int>(rows.high)).data(), levels.size(), share, levels.data());
        shift(field_time(line) * static_cast<double>(field_motion_px), levels);
      },
      picture);
}

/// @param scan  adds the frame's levels at a line, at the time of its field
void AnalogueLink::transmit(const Scan& scan, Plane<std::uint8_t>& picture) {
  assert(picture.width_px() == width_px_ && picture.height_px() == height_px_);
  const std::uint32_t frame = frame_++;
  draw_lines(frame);
  parallel_rows(lines_, kLinesPerChunk, [&](int line) {
    std::vector<float> levels(static_cast<std::size_t>(width_px_));
    scan(line, levels);
    send(frame, line, levels);
  });
  drop(frame);
  parallel_rows(height_px_, kLinesPerChunk, [&](int y) { record(y, picture.row(y)); });
}

/// Draws errors of a frame's lines: those of a field are correlated in time.
void AnalogueLink::draw_lines(std::uint32_t frame) {
  line_streaks_ = drawn(static_cast<double>(noise_.first), kLinkStreakStream, frame);
  line_px_ = drawn(parameters_.jitter_px, kLinkJitterStream, frame);
  line_levels_ = drawn(parameters_.row_levels, kLinkRowStream, frame);
  const std::vector<float> drifts = drawn(parameters_.drift_levels, kLinkDriftStream, frame);
  const double follows = std::exp(-1 / parameters_.drift_rows);
  const double fresh = std::sqrt(1 - follows * follows);
  const double field_lines = 0.5 * lines_;
  std::array<double, 2> drift{};
  for (std::size_t y = 0; y < drifts.size(); ++y) {
    double& here = drift[y % 2];
    const auto driven = static_cast<double>(drifts[y]);
    here = y < 2 ? driven : follows * here + fresh * driven;
    const std::size_t line = y / 2;
    const double fields = static_cast<double>(y % 2) + static_cast<double>(line) / field_lines;
    const double time_s = frame / frame_rate_hz_ + fields / parameters_.field_rate_hz;
    const double hum =
        std::numbers::sqrt2 * std::sin(2 * std::numbers::pi * (parameters_.hum_hz * time_s + hum_turns_));
    line_levels_[y] += static_cast<float>(here + parameters_.hum_levels * hum);
  }
}

/// The received levels of a line.
void AnalogueLink::send(std::uint32_t frame, int line, std::vector<float>& levels) {
  const auto at = static_cast<std::size_t>(line);
  if (noise_.fresh > 0) add_noise(frame, line, levels);
  std::vector<float> sent(levels.size());
  std::vector<float> padded;
  convolve_row(levels, bandwidth_, padded, sent);
  shift(static_cast<double>(line_px_[at]), sent);
  round_levels(sent.data(), sent.size(), line_levels_[at], received_.row(line).data());
}

void AnalogueLink::add_noise(std::uint32_t frame, int line, std::vector<float>& levels) const {
  std::vector<float> fresh(levels.size());
  fill_normal(field(kLinkNoiseStream, frame), static_cast<std::size_t>(line) * random_line(width_px_), fresh);
  add_scaled(fresh, noise_.fresh, levels);
  if (noise_.carried <= 0) return;
  float streak = line_streaks_[static_cast<std::size_t>(line)];
  for (std::size_t x = 0; x < levels.size(); ++x) {
    levels[x] += streak;
    streak = noise_.follows * streak + noise_.carried * fresh[x];
  }
}

/// Replaces pieces of lines by dropouts.
void AnalogueLink::drop(std::uint32_t frame) {
  if (parameters_.dropouts_per_s <= 0) return;
  const RandomField pieces = field(kLinkDropoutStream, frame);
  std::array<float, 4> random{};
  fill_uniform(pieces, 0, random);
  const int count =
      poisson(2 * parameters_.dropouts_per_s / parameters_.field_rate_hz, static_cast<double>(random[0]));
  const double mean_px = parameters_.dropout_us / parameters_.active_line_us * width_px_;
  for (int i = 1; i <= count; ++i) {
    fill_uniform(pieces, static_cast<std::size_t>(i) * kRandomBatch, random);
    const auto place = [](float share, int size) {
      return std::min(static_cast<int>(share * static_cast<float>(size)), size - 1);
    };
    const auto line = received_.row(place(random[0], lines_));
    const auto begin = static_cast<std::size_t>(place(random[1], width_px_));
    const double length_px = -mean_px * std::log1p(-static_cast<double>(random[2]));
    const auto end = begin + static_cast<std::size_t>(std::ceil(length_px));
    std::fill(line.begin() + static_cast<std::ptrdiff_t>(begin),
              line.begin() + static_cast<std::ptrdiff_t>(std::min(end, line.size())),
              random[3] < 0.5F ? std::uint8_t{0} : std::uint8_t{255});
  }
}

/// A row of the recorded frame.
void AnalogueLink::record(int y, std::span<std::uint8_t> row) const {
  const BetweenNodes lines = between_rows(y, height_px_, lines_);
  const auto share = static_cast<float>(lines.share_of_high);
  std::vector<float> levels(row.size());
  if (share < 1) add_recorded(static_cast<int>(lines.low), 1 - share, levels);
  if (share > 0) add_recorded(static_cast<int>(lines.high), share, levels);
  round_levels(levels.data(), levels.size(), 0, row.data());
}

/// Adds a line that the recorder computes from both fields.
void AnalogueLink::add_recorded(int line, float weight, std::vector<float>& levels) const {
  const auto add = [&](int of, float share) {
    add_weighted(received_.row(of).data(), levels.size(), share * weight, levels.data());
  };
  const bool is_even = line % 2 == 0;
  const bool is_kept = parameters_.deinterlace == Deinterlace::weave || lines_ == 1 ||
                       (parameters_.deinterlace == Deinterlace::bob && is_even);
  if (is_kept) return add(line, 1);
  const bool is_blended = parameters_.deinterlace == Deinterlace::blend;
  if (is_blended) add(line, 0.5F);
  add(line > 0 ? line - 1 : 1, is_blended ? 0.25F : 0.5F);
  add(line + 1 < lines_ ? line + 1 : line - 1, is_blended ? 0.25F : 0.5F);
}

}  // namespace thermal
