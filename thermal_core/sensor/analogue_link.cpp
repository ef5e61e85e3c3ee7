#include "sensor/analogue_link.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/rng.h"
#include "sensor/psf.h"
#include "sensor/streams.h"

namespace thermal {
namespace {

constexpr std::size_t kLinkRowsAChunk = 16;
constexpr float kWhiteLevel = 255;

/// Standard deviation [px] of the Gaussian that leaves half of the amplitude at the bandwidth.
double bandwidth_sigma_px(const AnalogueLinkParameters& link, int width_px) {
  const double cycles_per_px = link.bandwidth_mhz * link.active_line_us / width_px;
  return std::sqrt(0.5 * std::numbers::ln2) / (std::numbers::pi * cycles_per_px);
}

/// A whole number of batches of random numbers for each row.
std::size_t random_row(int width_px) {
  return (static_cast<std::size_t>(width_px) + kRandomBatch - 1) / kRandomBatch * kRandomBatch;
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

/// How many events a uniform number stands for, of a Poisson process with this mean.
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

/// Noise each of whose pixels is that before, faded by exp(-step), and a fresh part.
void add_streaks(const std::vector<float>& fresh, double levels, double step, std::vector<float>& row) {
  const auto follows = static_cast<float>(std::exp(-step));
  const auto amount = static_cast<float>(levels * std::sqrt(-std::expm1(-2 * step)));
  float streak = static_cast<float>(levels) * fresh.front();
  row.front() += streak;
  for (std::size_t x = 1; x < row.size(); ++x) {
    streak = follows * streak + amount * fresh[x];
    row[x] += streak;
  }
}

void shift(const std::vector<float>& row, double right_px, std::span<float> out) {
  const double whole = std::floor(right_px);
  const auto part = static_cast<float>(right_px - whole);
  const int last = static_cast<int>(row.size()) - 1;
  const auto at = [&](int x) { return row[static_cast<std::size_t>(std::clamp(x, 0, last))]; };
  for (int x = 0; x <= last; ++x) {
    const int from = x - static_cast<int>(whole);
    out[static_cast<std::size_t>(x)] = at(from) + part * (at(from - 1) - at(from));
  }
}

}  // namespace

AnalogueLink::AnalogueLink(const AnalogueLinkParameters& parameters, const Clip& clip)
    : parameters_(parameters),
      seed_(clip.seed),
      clip_(hash_name(clip.id)),
      frame_rate_hz_(clip.frame_rate_hz),
      width_px_(clip.width_px),
      height_px_(clip.height_px),
      bandwidth_(gaussian_psf(bandwidth_sigma_px(parameters, clip.width_px))),
      signal_(clip.width_px, clip.height_px) {
  assert(parameters.drift_rows > 0 && parameters.bandwidth_mhz > 0);
  float turns = 0;
  fill_uniform({.seed = seed_, .stream = kLinkHumStream, .clip = clip_, .frame = 0}, 0, std::span(&turns, 1));
  hum_turns_ = static_cast<double>(turns);
}

void AnalogueLink::pass(const ImageMotion& motion, Plane<std::uint8_t>& picture) {
  assert(picture.width_px() == width_px_ && picture.height_px() == height_px_);
  const std::uint32_t frame = frame_++;
  draw_rows(frame);
  const auto for_rows = [&](const auto& work) {
    parallel_for(static_cast<std::size_t>(height_px_), kLinkRowsAChunk,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t y = begin; y < end; ++y) work(static_cast<int>(y));
                 });
  };
  for_rows([&](int y) {
    std::vector<float> row(static_cast<std::size_t>(width_px_));
    std::vector<float> buffer;
    scan(motion, picture, y, row);
    send(frame, y, row, buffer);
  });
  drop(frame);
  for_rows([&](int y) {
    for (int x = 0; x < width_px_; ++x) {
      const float level = std::clamp(received(x, y) + 0.5F, 0.0F, kWhiteLevel);
      picture.at(x, y) = static_cast<std::uint8_t>(static_cast<std::int32_t>(level));
    }
  });
}

std::vector<float> AnalogueLink::normals(std::uint32_t stream, std::uint32_t frame, std::size_t first,
                                         std::size_t count) const {
  std::vector<float> values(count);
  fill_normal({.seed = seed_, .stream = stream, .clip = clip_, .frame = frame}, first, values);
  return values;
}

/// Level errors, and places, of a frame's rows: those of a field follow each other.
void AnalogueLink::draw_rows(std::uint32_t frame) {
  const auto rows = static_cast<std::size_t>(height_px_);
  const std::vector<float> drifts = normals(kLinkDriftStream, frame, 0, rows);
  row_levels_ = normals(kLinkRowStream, frame, 0, rows);
  row_px_ = normals(kLinkJitterStream, frame, 0, rows);
  const double follows = std::exp(-1 / parameters_.drift_rows);
  const double fresh = std::sqrt(1 - follows * follows);
  const double lines = 0.5 * height_px_;
  std::array<double, 2> drift{};
  for (std::size_t y = 0; y < rows; ++y) {
    double& here = drift[y % 2];
    const auto drawn = static_cast<double>(drifts[y]);
    here = y < 2 ? drawn : follows * here + fresh * drawn;
    const std::size_t line = y / 2;
    const double fields = static_cast<double>(y % 2) + static_cast<double>(line) / lines;
    const double time_s = frame / frame_rate_hz_ + fields / parameters_.field_rate_hz;
    const double hum =
        std::numbers::sqrt2 * std::sin(2 * std::numbers::pi * (parameters_.hum_hz * time_s + hum_turns_));
    row_levels_[y] = static_cast<float>(parameters_.row_levels * static_cast<double>(row_levels_[y]) +
                                        parameters_.drift_levels * here + parameters_.hum_levels * hum);
  }
}

/// The levels of a row at the time of its field.
void AnalogueLink::scan(const ImageMotion& motion, const Plane<std::uint8_t>& picture, int y,
                        std::vector<float>& row) const {
  const auto levels = picture.row(y);
  std::copy(levels.begin(), levels.end(), row.begin());
  if (motion.empty()) return;
  const double intervals = (y % 2 == 0 ? -0.5 : 0.5) * frame_rate_hz_ / parameters_.field_rate_hz;
  const auto share = static_cast<float>(intervals);
  for (int x = 0; x < width_px_; ++x) {
    const float right_px = share * motion.x_px.at(x, y);
    const float down_px = share * motion.y_px.at(x, y);
    row[static_cast<std::size_t>(x)] =
        level_between(picture, static_cast<float>(x) - right_px, static_cast<float>(y) - down_px);
  }
}

/// What arrives of a row.
void AnalogueLink::send(std::uint32_t frame, int y, std::vector<float>& row, std::vector<float>& buffer) {
  const auto at = static_cast<std::size_t>(y);
  if (parameters_.noise_levels > 0) {
    const std::vector<float> noise = normals(kLinkNoiseStream, frame, at * random_row(width_px_), row.size());
    const auto amount = static_cast<float>(parameters_.noise_levels);
    for (std::size_t x = 0; x < row.size(); ++x) row[x] += amount * noise[x];
  }
  if (parameters_.streak_levels > 0) {
    const std::vector<float> fresh =
        normals(kLinkStreakStream, frame, at * random_row(width_px_), row.size());
    add_streaks(fresh, parameters_.streak_levels,
                parameters_.active_line_us / width_px_ / parameters_.streak_us, row);
  }
  std::vector<float> sent(row.size());
  convolve_row(row, bandwidth_, buffer, sent);
  for (float& level : sent) level += row_levels_[at];
  shift(sent, parameters_.jitter_px * static_cast<double>(row_px_[at]), signal_.row(y));
}

/// Loses pieces of rows.
void AnalogueLink::drop(std::uint32_t frame) {
  if (parameters_.dropouts_per_s <= 0) return;
  const RandomField field = {.seed = seed_, .stream = kLinkDropoutStream, .clip = clip_, .frame = frame};
  std::array<float, 4> drawn{};
  fill_uniform(field, 0, drawn);
  const int count =
      poisson(2 * parameters_.dropouts_per_s / parameters_.field_rate_hz, static_cast<double>(drawn[0]));
  const double mean_px = parameters_.dropout_us / parameters_.active_line_us * width_px_;
  for (int i = 1; i <= count; ++i) {
    fill_uniform(field, static_cast<std::size_t>(i) * kRandomBatch, drawn);
    const auto place = [](float share, int size) {
      return std::min(static_cast<int>(share * static_cast<float>(size)), size - 1);
    };
    const auto row = signal_.row(place(drawn[0], height_px_));
    const auto begin = static_cast<std::size_t>(place(drawn[1], width_px_));
    const double length_px = -mean_px * std::log1p(-static_cast<double>(drawn[2]));
    const auto end = begin + static_cast<std::size_t>(std::ceil(length_px));
    std::fill(row.begin() + static_cast<std::ptrdiff_t>(begin),
              row.begin() + static_cast<std::ptrdiff_t>(std::min(end, row.size())),
              drawn[3] < 0.5F ? 0.0F : kWhiteLevel);
  }
}

/// The recorder's level at a pixel.
float AnalogueLink::received(int x, int y) const {
  const float here = signal_.at(x, y);
  if (parameters_.deinterlace == Deinterlace::weave || height_px_ == 1) return here;
  const float above = signal_.at(x, y > 0 ? y - 1 : 1);
  const float below = signal_.at(x, y + 1 < height_px_ ? y + 1 : y - 1);
  if (parameters_.deinterlace == Deinterlace::blend) return 0.5F * here + 0.25F * (above + below);
  return y % 2 == 0 ? here : 0.5F * (above + below);
}

}  // namespace thermal
