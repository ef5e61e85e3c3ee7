#include "sensor/smear.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "base/cholesky.h"
#include "base/clones.h"
#include "base/parallel.h"

namespace thermal {
namespace {

constexpr int kTileWidth = 32;
constexpr int kTileHeight = 16;
constexpr std::size_t kTileRowsPerChunk = 4;
// Of motion within Smear's reach:
constexpr float kStillPx = 1.0F / 64;  // ignored
constexpr float kAlikePx = 1.0F / 8;   // difference within a tile that has one motion
constexpr int kStepsPerPx = 16;        // to which motion is rounded, so that its samples can be reused

constexpr float kFarthestPx = 4096;  // longer motion counts as this
constexpr int kMarginPx = 44;        // kept beyond the edges: the reach of all but long motion
constexpr double kSettled = 8;       // time constants after which a pixel's response has decayed
constexpr std::size_t kMostRemembered = 4096;
constexpr int kReadSteps = 64;  // of an interval, to which a row's time of reading is rounded
constexpr std::int64_t kReadTimes = 2 * kReadSteps;     // in one number with a motion
constexpr std::int64_t kAxis = std::int64_t{1} << 32U;  // between the axes of a motion in one number

/// Adds four weighted samples to each sum, and finds the minimum of all. A function of its own: within the loop over
/// the samples, GCC 12 fuses two iterations into one that it cannot vectorise.
VELDT_CLONES void mix_four(const float* from, const std::ptrdiff_t* offsets, const float* weights,
                           std::size_t count, float* __restrict sum, float* __restrict least) {
  const float* a = from + offsets[0];
  const float* b = from + offsets[1];
  const float* c = from + offsets[2];
  const float* d = from + offsets[3];
  const float wa = weights[0];
  const float wb = weights[1];
  const float wc = weights[2];
  const float wd = weights[3];
  for (std::size_t i = 0; i < count; ++i) {
    sum[i] += (wa * a[i] + wb * b[i]) + (wc * c[i] + wd * d[i]);
    const float ab = a[i] < b[i] ? a[i] : b[i];
    const float cd = c[i] < d[i] ? c[i] : d[i];
    const float low = ab < cd ? ab : cd;
    least[i] = low < least[i] ? low : least[i];
  }
}

VELDT_CLONES void greater(const float* one, const float* other, std::size_t count, float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = one[i] > other[i] ? one[i] : other[i];
}

/// The sum of weighted samples, at least their minimum. `count` is at most kTileWidth.
void mix_line(const float* from, const std::ptrdiff_t* offsets, const float* weights, std::size_t taps,
              std::size_t count, float* out) {
  std::array<float, kTileWidth> sum{};
  std::array<float, kTileWidth> least{};
  least.fill(std::numeric_limits<float>::max());
  for (std::size_t tap = 0; tap < taps; tap += 4)
    mix_four(from, offsets + tap, weights + tap, count, sum.data(), least.data());
  greater(sum.data(), least.data(), count, out);
}

/// The picture with a margin of replicated edge pixels.
void copy_with_margin(const Plane<float>& picture, Plane<float>& out) {
  const int width = picture.width_px() + 2 * kMarginPx;
  const int height = picture.height_px() + 2 * kMarginPx;
  out.resize(width, height);
  for (int y = 0; y < height; ++y) {
    const std::span<const float> from = picture.row(std::clamp(y - kMarginPx, 0, picture.height_px() - 1));
    const std::span<float> to = out.row(y);
    std::ranges::fill(to.first(kMarginPx), from.front());
    std::ranges::copy(from, to.begin() + kMarginPx);
    std::ranges::fill(to.last(kMarginPx), from.back());
  }
}

/// Clamped; 0 if not finite.
float limited(float px) { return std::isfinite(px) ? std::clamp(px, -kFarthestPx, kFarthestPx) : 0; }

struct Steps {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t read = 0;  ///< position in the readout, relative to the frame's time

  [[nodiscard]] std::int64_t packed() const noexcept {
    return (x * kAxis + y) * kReadTimes + read + kReadTimes / 2;
  }
  [[nodiscard]] static Steps unpacked(std::int64_t number) noexcept {
    const auto floor_of = [](std::int64_t value, std::int64_t size) {
      return value / size - (value % size < 0 ? 1 : 0);
    };
    const std::int64_t motion = floor_of(number, kReadTimes);
    const std::int64_t x = floor_of(motion + kAxis / 2, kAxis);
    return {.x = x, .y = motion - x * kAxis, .read = number - motion * kReadTimes - kReadTimes / 2};
  }
};

/// @param steps_per_px  of motion within an interval
Steps steps_of(float x_px, float y_px, float steps_per_px) {
  return {.x = std::lround(limited(x_px) * steps_per_px), .y = std::lround(limited(y_px) * steps_per_px)};
}

/// Minimum and maximum of a tile, by column and in total. NaN is left out.
class Range {
 public:
  Range() {
    low_.fill(std::numeric_limits<float>::max());
    high_.fill(std::numeric_limits<float>::lowest());
  }
  void widen(std::span<const float> line) noexcept {
    widen(line.data(), line.size(), low_.data(), high_.data());
  }
  [[nodiscard]] float low() const { return *std::ranges::min_element(low_); }
  [[nodiscard]] float high() const { return *std::ranges::max_element(high_); }

 private:
  VELDT_CLONES static void widen(const float* values, std::size_t count, float* __restrict low,
                                 float* __restrict high) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
      low[i] = values[i] < low[i] ? values[i] : low[i];
      high[i] = values[i] > high[i] ? values[i] : high[i];
    }
  }

  std::array<float, kTileWidth> low_{};
  std::array<float, kTileWidth> high_{};
};

}  // namespace

/// Divides a row of tiles into pieces.
class Smear::Cutter {
 public:
  /// @param reach, readout  in intervals
  Cutter(const ImageMotion& motion, double reach, double readout, std::vector<Piece>& out)
      : motion_(motion), reach_(static_cast<float>(reach)), readout_(readout), out_(out) {}

  void cut(int x, int y, int width, int height) {
    Range across;
    Range down;
    for (int row = y; row < y + height; ++row) {
      const auto line = [&](const Plane<float>& plane) {
        return plane.row(row).subspan(static_cast<std::size_t>(x), static_cast<std::size_t>(width));
      };
      across.widen(line(motion_.x_px));
      down.widen(line(motion_.y_px));
    }
    const float left = across.low();
    const float right = across.high();
    const float top = down.low();
    const float bottom = down.high();
    if (is_still(left, top) && is_still(right, bottom)) return;
    if (reach_ * (right - left) <= kAlikePx && reach_ * (bottom - top) <= kAlikePx) {
      add({.x = x, .y = y, .width = width, .height = height}, (left + right) / 2, (top + bottom) / 2);
      return;
    }
    for (int row = y; row < y + height; ++row) cut_row(x, row, x + width);
  }

 private:
  /// Neighbours with one motion are one piece.
  void cut_row(int begin, int y, int end) {
    while (begin < end) {
      const float x_px = motion_.x_px.at(begin, y);
      const float y_px = motion_.y_px.at(begin, y);
      int after = begin + 1;
      while (after < end && reach_ * std::abs(motion_.x_px.at(after, y) - x_px) <= kAlikePx / 2 &&
             reach_ * std::abs(motion_.y_px.at(after, y) - y_px) <= kAlikePx / 2)
        ++after;
      if (!is_still(x_px, y_px)) add({.x = begin, .y = y, .width = after - begin, .height = 1}, x_px, y_px);
      begin = after;
    }
  }

  /// NaN counts as still.
  [[nodiscard]] bool is_still(float x_px, float y_px) const noexcept {
    return !(reach_ * std::abs(x_px) >= kStillPx) && !(reach_ * std::abs(y_px) >= kStillPx);
  }

  /// Adds a piece, divided where the readout time changes.
  void add(Piece piece, float x_px, float y_px) {
    Steps steps = steps_of(x_px, y_px, kStepsPerPx * reach_);
    if (steps.x == 0 && steps.y == 0) return;
    const int end = piece.y + piece.height;
    while (piece.y < end) {
      steps.read = read_at(piece.y);
      piece.height = 1;
      while (piece.y + piece.height < end && read_at(piece.y + piece.height) == steps.read) ++piece.height;
      piece.motion = steps.packed();
      out_.push_back(piece);
      piece.y += piece.height;
    }
  }

  [[nodiscard]] std::int64_t read_at(int y) const noexcept {
    const double share = (y + 0.5) / motion_.x_px.height_px() - 0.5;
    return std::lround(share * readout_ * kReadSteps);
  }

  const ImageMotion& motion_;
  float reach_;
  double readout_;
  std::vector<Piece>& out_;
};

Smear::Smear(double interval_s, double time_constant_s, double readout_s)
    : ages_(interval_s / time_constant_s),
      readout_(readout_s / interval_s),
      reach_(std::min(1.0, std::max(1 / ages_, readout_ / 2))) {
  assert(interval_s > 0 && time_constant_s > 0 && readout_s >= 0 && readout_s <= interval_s);
}

void Smear::apply(const ImageMotion& motion, Plane<float>& picture) { apply(motion, picture, ages_, 1); }

void Smear::apply_to_first(const ImageMotion& motion, Plane<float>& picture) {
  const double intervals = std::max(1.0, kSettled / ages_);
  apply(motion, picture, ages_ * intervals, intervals);
  samples_.clear();
}

void Smear::apply(const ImageMotion& motion, Plane<float>& picture, double ages, double intervals) {
  if (motion.empty() || picture.empty()) return;
  assert(motion.x_px.size() == picture.size() && motion.y_px.size() == picture.size());
  const int rows = (picture.height_px() + kTileHeight - 1) / kTileHeight;
  pieces_.resize(static_cast<std::size_t>(rows));
  parallel_rows(rows, kTileRowsPerChunk, [&](int row) {
    std::vector<Piece>& pieces = pieces_[static_cast<std::size_t>(row)];
    pieces.clear();
    Cutter cutter(motion, reach_, readout_, pieces);
    const int y = row * kTileHeight;
    const int height = std::min(kTileHeight, picture.height_px() - y);
    for (int x = 0; x < picture.width_px(); x += kTileWidth)
      cutter.cut(x, y, std::min(kTileWidth, picture.width_px() - x), height);
  });
  if (std::ranges::all_of(pieces_, [](const auto& row) { return row.empty(); })) return;
  copy_with_margin(picture, sharp_);
  find_samples(ages, intervals);
  parallel_rows(rows, kTileRowsPerChunk, [&](int row) {
    for (const Piece& piece : pieces_[static_cast<std::size_t>(row)]) mix(piece, picture);
  });
}

void Smear::find_samples(double ages, double intervals) {
  if (samples_.size() > kMostRemembered) samples_.clear();
  std::vector<std::pair<const std::int64_t, Samples>*> missing;
  for (std::vector<Piece>& row : pieces_) {
    for (Piece& piece : row) {
      const auto [found, is_new] = samples_.try_emplace(piece.motion);
      if (is_new) missing.push_back(&*found);
      piece.samples = &found->second;
    }
  }
  parallel_for(missing.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      missing[k]->second = samples_of(missing[k]->first, ages, intervals);
  });
}

Smear::Samples Smear::samples_of(std::int64_t motion, double ages, double intervals) const {
  const Steps steps = Steps::unpacked(motion);
  const double interval_px = intervals / (kStepsPerPx * reach_);
  const double begins = -static_cast<double>(steps.read) / (kReadSteps * intervals);
  Samples samples;
  samples.taps = smear_taps(static_cast<double>(steps.x) * interval_px,
                            static_cast<double>(steps.y) * interval_px, ages, begins);
  while (samples.taps.size() % 4 != 0) {
    samples.taps.push_back(samples.taps.front());
    samples.taps.back().weight = 0;
  }
  samples.weights.reserve(samples.taps.size());
  samples.offsets.reserve(samples.taps.size());
  for (const SmearTap& tap : samples.taps) {
    samples.weights.push_back(tap.weight);
    samples.offsets.push_back(static_cast<std::ptrdiff_t>(tap.y_px) * sharp_.width_px() + tap.x_px);
    samples.left_px = std::min(samples.left_px, tap.x_px);
    samples.right_px = std::max(samples.right_px, tap.x_px);
    samples.up_px = std::min(samples.up_px, tap.y_px);
    samples.down_px = std::max(samples.down_px, tap.y_px);
  }
  return samples;
}

void Smear::mix(const Piece& piece, Plane<float>& picture) const {
  const Samples& samples = *piece.samples;
  const int x = piece.x + kMarginPx;
  const int y = piece.y + kMarginPx;
  if (x + samples.left_px < 0 || x + piece.width + samples.right_px > sharp_.width_px() ||
      y + samples.up_px < 0 || y + piece.height + samples.down_px > sharp_.height_px()) {
    mix_far(piece, picture);
    return;
  }
  for (int line = 0; line < piece.height; ++line)
    mix_line(&sharp_.at(x, y + line), samples.offsets.data(), samples.weights.data(), samples.weights.size(),
             static_cast<std::size_t>(piece.width), &picture.at(piece.x, piece.y + line));
}

/// For motion beyond the margin: copies the samples of each line.
void Smear::mix_far(const Piece& piece, Plane<float>& picture) const {
  const Samples& samples = *piece.samples;
  const auto width = static_cast<std::size_t>(piece.width);
  std::vector<float> copied(samples.taps.size() * width);
  std::vector<std::ptrdiff_t> offsets(samples.taps.size());
  for (std::size_t tap = 0; tap < offsets.size(); ++tap)
    offsets[tap] = static_cast<std::ptrdiff_t>(tap * width);
  for (int y = piece.y; y < piece.y + piece.height; ++y) {
    for (std::size_t tap = 0; tap < samples.taps.size(); ++tap) {
      const SmearTap& from = samples.taps[tap];
      const std::span<const float> row =
          sharp_.row(std::clamp(y + kMarginPx + from.y_px, 0, sharp_.height_px() - 1));
      for (int i = 0; i < piece.width; ++i)
        copied[tap * width + static_cast<std::size_t>(i)] = row[static_cast<std::size_t>(
            std::clamp(piece.x + kMarginPx + from.x_px + i, 0, sharp_.width_px() - 1))];
    }
    mix_line(copied.data(), offsets.data(), samples.weights.data(), offsets.size(), width,
             &picture.at(piece.x, y));
  }
}

namespace {

using std::numbers::pi;

constexpr double kOldest = 16;         // time constants: older samples weigh 1e-7
constexpr double kLongPx = 40;         // longer motion is sampled more coarsely
constexpr int kMostNodes = 66;         // of the quadrature of shorter motion
constexpr int kMostSteps = 256;        // of longer motion
constexpr int kReachPx = 3;            // of the interpolation
constexpr double kLeastWeight = 1e-3;  // of a sample that is kept

struct Node {
  double position = 0;  ///< 0 to 1 within the interval
  double weight = 0;
};

/// Nodes and weights of Gauss and Legendre on 0 to 1, by Newton's method (Numerical Recipes, 4.6).
std::vector<Node> legendre_nodes(int count) {
  std::vector<Node> nodes;
  for (int i = 0; i < count; ++i) {
    double x = std::cos(pi * (i + 0.75) / (count + 0.5));
    double slope = 1;
    for (int step = 0; step < 8; ++step) {
      double value = 1;
      double before = 0;
      for (int k = 0; k < count; ++k) {
        const double older = before;
        before = value;
        value = ((2 * k + 1) * x * before - k * older) / (k + 1);
      }
      slope = count * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    nodes.push_back({.position = (1 - x) / 2, .weight = 1 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

const std::vector<Node>& nodes_of(int count) {
  static const auto kAll = [] {
    std::array<std::vector<Node>, kMostNodes + 1> all;
    for (int n = 1; n <= kMostNodes; ++n) all.at(static_cast<std::size_t>(n)) = legendre_nodes(n);
    return all;
  }();
  return kAll.at(static_cast<std::size_t>(count));
}

constexpr std::size_t kSamples = 2 * kReachPx;
constexpr std::size_t kLanes = 8;  // fills the processor's registers; lanes past the samples are 0
using Weights = std::array<double, kLanes>;

/// Adds the products of weights down and across to a part of a grid.
VELDT_CLONES void add_products(const double* down, const double* across, double* __restrict out,
                               std::size_t width) {
  for (std::size_t row = 0; row < kSamples; ++row, out += width)
    for (std::size_t i = 0; i < kLanes; ++i) out[i] += down[row] * across[i];
}

VELDT_CLONES void mix_weights(const double* one, const double* other, double share, double* __restrict out) {
  for (std::size_t i = 0; i < kLanes; ++i) out[i] = (1 - share) * one[i] + share * other[i];
}

/// Mean of cos(2 pi f x) over the frequencies that the interpolation is optimised for.
double correlation(double px) {
  constexpr double kBand = 0.32;  // cycles per pixel
  const double x = 2 * pi * kBand * px;
  return std::abs(x) < 1e-9 ? 1 : std::sin(x) / x;
}

/// Weights with a sum of 1 whose transfer is closest, by least squares over these frequencies, to a shift by a fraction
/// of a pixel.
Weights shift_weights(double fraction) {
  std::vector<double> matrix;
  std::vector<double> right;
  for (int i = 0; i < static_cast<int>(kSamples); ++i) {
    for (int k = 0; k < static_cast<int>(kSamples); ++k) matrix.push_back(correlation(i - k));
    right.push_back(correlation(i - (kReachPx - 1) - fraction));
  }
  Weights weights{};
  std::ranges::copy(solve_with_sum(matrix, right, std::vector<double>(kSamples, 1)), weights.begin());
  return weights;
}

/// Interpolation weights of the 6 samples around a position, by its fraction of a pixel.
class Interpolation {
 public:
  Interpolation() {
    for (std::size_t step = 0; step < all_.size(); ++step)
      all_.at(step) = shift_weights(static_cast<double>(step) / kSteps);
  }

  [[nodiscard]] Weights at(double fraction) const {
    const double position = fraction * kSteps;
    const auto step = static_cast<std::size_t>(std::min(position, kSteps - 1.0));
    const double share = position - static_cast<double>(step);
    Weights weights{};
    mix_weights(all_.at(step).data(), all_.at(step + 1).data(), share, weights.data());
    return weights;
  }

 private:
  static constexpr int kSteps = 256;
  std::array<Weights, kSteps + 1> all_{};
};

/// Path of a pixel's samples, from the youngest (0) to the oldest (1).
struct Way {
  double from_x_px = 0;
  double from_y_px = 0;
  double x_px = 0;
  double y_px = 0;

  [[nodiscard]] double x_at(double position) const noexcept { return from_x_px + position * x_px; }
  [[nodiscard]] double y_at(double position) const noexcept { return from_y_px + position * y_px; }
  [[nodiscard]] double length_px() const noexcept { return std::hypot(x_px, y_px); }
};

/// Sums of weights over a rectangle of samples.
class TapGrid {
 public:
  explicit TapGrid(const Way& way)
      : left_(static_cast<int>(std::floor(std::min(way.from_x_px, way.from_x_px + way.x_px))) - kReachPx),
        top_(static_cast<int>(std::floor(std::min(way.from_y_px, way.from_y_px + way.y_px))) - kReachPx),
        width_(static_cast<int>(std::ceil(std::abs(way.x_px)) + kLanes + 3)),
        weights_(static_cast<std::size_t>(width_) *
                 static_cast<std::size_t>(std::ceil(std::abs(way.y_px)) + kSamples + 3)) {}

  void add(double x_px, double y_px, double weight) {
    static const Interpolation kInterpolation;
    const double x = std::floor(x_px);
    const double y = std::floor(y_px);
    const Weights across = kInterpolation.at(x_px - x);
    Weights down = kInterpolation.at(y_px - y);
    for (double& share : down) share *= weight;
    const int first_x = static_cast<int>(x) - (kReachPx - 1) - left_;
    const int first_y = static_cast<int>(y) - (kReachPx - 1) - top_;
    add_products(down.data(), across.data(), &weights_[static_cast<std::size_t>(first_y * width_ + first_x)],
                 static_cast<std::size_t>(width_));
  }

  [[nodiscard]] std::vector<SmearTap> taps() const {
    std::vector<SmearTap> taps;
    taps.reserve(weights_.size());
    double sum = 0;
    for (const double weight : weights_) sum += std::abs(weight) < kLeastWeight ? 0 : weight;
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      if (std::abs(weights_[i]) < kLeastWeight) continue;
      const auto at = static_cast<int>(i);
      taps.push_back({.x_px = left_ + at % width_,
                      .y_px = top_ + at / width_,
                      .weight = static_cast<float>(weights_[i] / sum)});
    }
    return taps;
  }

 private:
  int left_;
  int top_;
  int width_;
  std::vector<double> weights_;
};

std::vector<SmearTap> short_taps(const Way& way, double ages) {
  TapGrid grid(way);
  for (const Node& node : nodes_of(6 + static_cast<int>(std::ceil(1.5 * way.length_px())))) {
    const double density = ages * std::exp(-ages * node.position) / -std::expm1(-ages);
    grid.add(way.x_at(node.position), way.y_at(node.position), node.weight * density);
  }
  return grid.taps();
}

/// Integral of the age, in intervals, over the youngest `share` of the weight.
double age_integral(double share, double ages) {
  const double all = -std::expm1(-ages);
  const double rest = 1 - all * share;
  return ((rest > 0 ? rest * std::log(rest) : 0) + all * share) / (all * ages);
}

/// Steps of equal weight, each at its mean age, between four pixels.
std::vector<SmearTap> long_taps(const Way& way, double ages) {
  const double dense_px = way.length_px() * std::min(1.0, 1 / ages);
  const int steps = std::clamp(static_cast<int>(std::ceil(8 * dense_px)), 64, kMostSteps);
  std::vector<SmearTap> taps;
  taps.reserve(4 * static_cast<std::size_t>(steps));
  for (int i = 0; i < steps; ++i) {
    const double position =
        steps * (age_integral((i + 1.0) / steps, ages) - age_integral(static_cast<double>(i) / steps, ages));
    const double x = std::floor(way.x_at(position));
    const double y = std::floor(way.y_at(position));
    const double right = way.x_at(position) - x;
    const double down = way.y_at(position) - y;
    for (int corner = 0; corner < 4; ++corner) {
      const double share = (corner % 2 == 1 ? right : 1 - right) * (corner / 2 == 1 ? down : 1 - down);
      taps.push_back({.x_px = static_cast<int>(x) + corner % 2,
                      .y_px = static_cast<int>(y) + corner / 2,
                      .weight = static_cast<float>(share / steps)});
    }
  }
  return taps;
}

}  // namespace

std::vector<SmearTap> smear_taps(double x_px, double y_px, double ages, double begins) {
  const double shown = std::min(1.0, kOldest / ages);
  const Way way = {
      .from_x_px = begins * x_px, .from_y_px = begins * y_px, .x_px = x_px * shown, .y_px = y_px * shown};
  return way.length_px() < kLongPx ? short_taps(way, ages * shown) : long_taps(way, ages * shown);
}

}  // namespace thermal
