#include "sensor/processing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <span>

#include "base/clones.h"
#include "base/parallel.h"
#include "sensor/optics/psf.h"

namespace thermal {
namespace {

constexpr std::size_t kFilteredPixelsPerChunk = 16384;
constexpr std::size_t kFilteredRowsPerChunk = 32;

VELDT_CLONES void subtract(const float* signal, const float* mean, std::size_t count, float* change) {
  for (std::size_t i = 0; i < count; ++i) change[i] = signal[i] - mean[i];
}

VELDT_CLONES void add_rows(const float* up, const float* here, const float* down, std::size_t count,
                           float* sum) {
  for (std::size_t i = 0; i < count; ++i) sum[i] = up[i] + here[i] + down[i];
}

VELDT_INLINE float size_of_change(float change) { return change < 0 ? -change : change; }

/// `columns` are sums of three rows of `change`, and begin one column earlier.
VELDT_CLONES void follow_or_jump(const float* change, const float* columns, std::size_t count, float share,
                                 float limit, float* mean, float* signal) {
  for (std::size_t i = 0; i < count; ++i) {
    const float around = columns[i] + columns[i + 1] + columns[i + 2];
    const float alone = 3 * size_of_change(change[i]);
    const float together = size_of_change(around);
    const bool moves = (alone > together ? alone : together) > 3 * limit;
    const float mixed = mean[i] + share * change[i];
    mean[i] = moves ? signal[i] : mixed;
    signal[i] = mean[i];
  }
}

}  // namespace

TemporalFilter::TemporalFilter(const DenoiseParameters& parameters, float noise_w_m2_sr)
    : share_(static_cast<float>(parameters.share_of_new)),
      limit_w_m2_sr_(
          static_cast<float>(parameters.motion_sigma * std::sqrt(2 / (2 - parameters.share_of_new)) *
                             static_cast<double>(noise_w_m2_sr))) {}

void TemporalFilter::apply(Plane<float>& signal_w_m2_sr) {
  const auto signal = signal_w_m2_sr.pixels();
  if (mean_.empty()) mean_.assign(signal.begin(), signal.end());
  take_changes(signal_w_m2_sr);
  parallel_rows(signal_w_m2_sr.height_px(), kFilteredRowsPerChunk,
                [&](int y) { follow_row(y, signal_w_m2_sr); });
}

void TemporalFilter::take_changes(const Plane<float>& signal_w_m2_sr) {
  change_.resize(signal_w_m2_sr.width_px(), signal_w_m2_sr.height_px());
  const auto signal = signal_w_m2_sr.pixels();
  const auto change = change_.pixels();
  parallel_for(signal.size(), kFilteredPixelsPerChunk, [&](std::size_t begin, std::size_t end) {
    subtract(&signal[begin], &mean_[begin], end - begin, &change[begin]);
  });
}

/// Changes are replicated beyond the border.
void TemporalFilter::follow_row(int y, Plane<float>& signal_w_m2_sr) {
  const std::span<const float> here = change_.row(y);
  std::vector<float> columns(here.size() + 2);
  add_rows(change_.row(std::max(y - 1, 0)).data(), here.data(),
           change_.row(std::min(y + 1, change_.height_px() - 1)).data(), here.size(), &columns[1]);
  columns.front() = columns[1];
  columns.back() = columns[here.size()];
  follow_or_jump(here.data(), columns.data(), here.size(), share_, limit_w_m2_sr_,
                 &mean_[static_cast<std::size_t>(y) * here.size()], signal_w_m2_sr.row(y).data());
}

namespace {

constexpr std::size_t kProcessedRowsPerChunk = 32;

VELDT_CLONES void set_counts(const std::uint16_t* in, std::size_t size, float weight, float* out) {
  for (std::size_t i = 0; i < size; ++i)
    out[i] = weight * static_cast<float>(static_cast<std::int32_t>(in[i]));
}

VELDT_CLONES void add_pairs_of_counts(const std::uint16_t* one, const std::uint16_t* other, std::size_t size,
                                      float weight, float* out) {
  for (std::size_t i = 0; i < size; ++i) {
    const std::int32_t sum = static_cast<std::int32_t>(one[i]) + static_cast<std::int32_t>(other[i]);
    out[i] += weight * static_cast<float>(sum);
  }
}

/// A row convolved along columns, mirrored at the borders.
void convolve_columns(const Plane<std::uint16_t>& ir16, int y, const HalfKernel& kernel,
                      std::vector<float>& out) {
  set_counts(ir16.row(y).data(), out.size(), kernel[0], out.data());
  for (int offset = 1; offset < static_cast<int>(kernel.size()); ++offset)
    add_pairs_of_counts(ir16.row(mirrored(y - offset, ir16.height_px())).data(),
                        ir16.row(mirrored(y + offset, ir16.height_px())).data(), out.size(),
                        kernel[static_cast<std::size_t>(offset)], out.data());
}

/// Both kernels in sequence.
HalfKernel convolved(const HalfKernel& one, const HalfKernel& other) {
  const auto reach = static_cast<int>(one.size()) - 1;
  const auto others = static_cast<int>(other.size());
  std::vector<double> weights(one.size() + other.size() - 1);
  for (int at = 0; at < static_cast<int>(weights.size()); ++at) {
    for (int from = std::max(-reach, at - others + 1); from <= std::min(reach, at + others - 1); ++from)
      weights[static_cast<std::size_t>(at)] +=
          static_cast<double>(one[static_cast<std::size_t>(std::abs(from))]) *
          static_cast<double>(other[static_cast<std::size_t>(std::abs(at - from))]);
  }
  return rounded_kernel(weights);
}

VELDT_CLONES void mask(const float* sharp, const float* blurred, float amount, const std::uint16_t* in,
                       std::size_t count, std::uint16_t* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const float value = sharp[i] + amount * (sharp[i] - blurred[i]) + 0.5F;
    const float above = value > 1 ? value : 1;
    const float within = above < 65534 ? above : 65534;
    const bool is_measured = in[i] != 0 && in[i] != 65535;
    out[i] = static_cast<std::uint16_t>(is_measured ? static_cast<std::int32_t>(within)
                                                    : static_cast<std::int32_t>(in[i]));
  }
}

}  // namespace

Processing::Processing(const ProcessingParameters& parameters)
    : unsharp_amount_(static_cast<float>(parameters.unsharp_amount)),
      noise_filter_(gaussian_psf(parameters.noise_filter_sigma_px)) {
  if (unsharp_amount_ > 0) blur_ = convolved(noise_filter_, gaussian_psf(parameters.unsharp_sigma_px));
}

const Plane<std::uint16_t>& Processing::filter(const Plane<std::uint16_t>& ir16) {
  if (blur_.empty() && noise_filter_.size() == 1) return ir16;
  filtered_.resize(ir16.width_px(), ir16.height_px());
  parallel_rows(ir16.height_px(), kProcessedRowsPerChunk, [&](int y) {
    std::vector<float> down(static_cast<std::size_t>(ir16.width_px()));
    std::vector<float> padded;
    const auto blur = [&](const HalfKernel& kernel) {
      std::vector<float> out(down.size());
      convolve_columns(ir16, y, kernel, down);
      convolve_row(down, kernel, padded, out);
      return out;
    };
    const std::vector<float> sharp = blur(noise_filter_);
    std::vector<float> blurred;
    if (!blur_.empty()) blurred = blur(blur_);
    mask(sharp.data(), blur_.empty() ? sharp.data() : blurred.data(), unsharp_amount_, ir16.row(y).data(),
         sharp.size(), filtered_.row(y).data());
  });
  return filtered_;
}

namespace {

constexpr std::size_t kDetailRowsPerChunk = 16;

VELDT_CLONES void add_counts(const std::uint16_t* counts, std::size_t size, double* sum, double* squares) {
  for (std::size_t i = 0; i < size; ++i) {
    const auto count = static_cast<double>(static_cast<std::int32_t>(counts[i]));
    sum[i] += count;
    squares[i] += count * count;
  }
}

VELDT_CLONES void add_values(const float* values, std::size_t size, float* sum) {
  for (std::size_t i = 0; i < size; ++i) sum[i] += values[i];
}

VELDT_CLONES void add_doubles(const double* values, std::size_t size, double* sum) {
  for (std::size_t i = 0; i < size; ++i) sum[i] += values[i];
}

/// Gain and offset of He's local model base = gain x count + offset, from sums over `pixels`.
VELDT_CLONES void fit_models(const double* sum, const double* squares, std::size_t size, double pixels,
                             double edge_counts2, float* gain, float* offset) {
  for (std::size_t i = 0; i < size; ++i) {
    const double mean = sum[i] / pixels;
    const double variance =
        squares[i] / pixels - mean * mean;  // of integers below 2^53: exact but for the mean
    const double positive = variance > 0 ? variance : 0;
    const double slope = positive / (positive + edge_counts2);
    gain[i] = static_cast<float>(slope);
    offset[i] = static_cast<float>(mean * (1 - slope));
  }
}

VELDT_CLONES void subtract_base(const std::uint16_t* counts, const float* gains, const float* offsets,
                                std::size_t size, float per_pixel, float* detail) {
  for (std::size_t i = 0; i < size; ++i) {
    const auto count = static_cast<float>(static_cast<std::int32_t>(counts[i]));
    detail[i] = count * (1 - per_pixel * gains[i]) - per_pixel * offsets[i];
  }
}

/// Sums along a row over 2 radius + 1 values, from `padded`, which has `radius` more of them at either end.
template <typename T, typename Add>
void sum_along(const std::vector<T>& padded, int radius, Add add, std::vector<T>& out) {
  std::ranges::fill(out, T{0});
  for (int k = 0; k <= 2 * radius; ++k) add(&padded[static_cast<std::size_t>(k)], out.size(), out.data());
}

template <typename T>
void repeat_ends(std::vector<T>& padded, int radius) {
  const auto beyond = static_cast<std::size_t>(radius);
  std::fill_n(padded.begin(), beyond, padded[beyond]);
  std::fill_n(padded.end() - radius, beyond, padded[padded.size() - beyond - 1]);
}

/// Rows and columns within a radius; beyond the border, edge pixels are replicated.
struct Window {
  int width_px;
  int height_px;
  int radius_px;

  [[nodiscard]] std::size_t padded() const { return static_cast<std::size_t>(width_px + 2 * radius_px); }
  [[nodiscard]] int row(int y) const { return std::clamp(y, 0, height_px - 1); }
  [[nodiscard]] double pixels() const { return (2.0 * radius_px + 1) * (2.0 * radius_px + 1); }
};

/// Fits a row of windows.
void fit_row(const Plane<std::uint16_t>& ir16, const Window& window, int y, double edge_counts2, float* gain,
             float* offset) {
  std::vector<double> sum(window.padded());
  std::vector<double> squares(window.padded());
  const auto width = static_cast<std::size_t>(window.width_px);
  for (int k = -window.radius_px; k <= window.radius_px; ++k)
    add_counts(ir16.row(window.row(y + k)).data(), width, &sum[static_cast<std::size_t>(window.radius_px)],
               &squares[static_cast<std::size_t>(window.radius_px)]);
  repeat_ends(sum, window.radius_px);
  repeat_ends(squares, window.radius_px);
  std::vector<double> all(width);
  std::vector<double> all_squares(width);
  sum_along(sum, window.radius_px, add_doubles, all);
  sum_along(squares, window.radius_px, add_doubles, all_squares);
  fit_models(all.data(), all_squares.data(), width, window.pixels(), edge_counts2, gain, offset);
}

/// Sums of a plane over the windows of a row.
void sum_row(const Plane<float>& plane, const Window& window, int y, std::vector<float>& out) {
  std::vector<float> sum(window.padded());
  for (int k = -window.radius_px; k <= window.radius_px; ++k)
    add_values(plane.row(window.row(y + k)).data(), out.size(),
               &sum[static_cast<std::size_t>(window.radius_px)]);
  repeat_ends(sum, window.radius_px);
  sum_along(sum, window.radius_px, add_values, out);
}

VELDT_CLONES void add_detail(const std::uint16_t* counts, const float* detail, std::size_t size,
                             float levels_per_count, float noise_counts, float darkest, float brightest,
                             std::uint8_t* levels) {
  for (std::size_t i = 0; i < size; ++i) {
    const float amount = detail[i] < 0 ? -detail[i] : detail[i];
    const float beyond = amount > noise_counts ? amount - noise_counts : 0;
    const float change = levels_per_count * (detail[i] < 0 ? -beyond : beyond);
    const auto before = static_cast<std::int32_t>(levels[i]);
    const float level = static_cast<float>(before) + change + 0.5F;
    const float above = level > darkest ? level : darkest;
    const auto within = static_cast<std::int32_t>(above < brightest ? above : brightest);
    const bool is_measured = counts[i] != 0 && counts[i] != 65535;
    levels[i] = static_cast<std::uint8_t>(is_measured ? within : before);
  }
}

}  // namespace

void find_detail(const Plane<std::uint16_t>& ir16, int radius_px, double edge_counts,
                 Plane<float>& detail_counts) {
  const Window window = {.width_px = ir16.width_px(), .height_px = ir16.height_px(), .radius_px = radius_px};
  Plane<float> gain(window.width_px, window.height_px);
  Plane<float> offset(window.width_px, window.height_px);
  parallel_rows(window.height_px, kDetailRowsPerChunk, [&](int y) {
    fit_row(ir16, window, y, edge_counts * edge_counts, gain.row(y).data(), offset.row(y).data());
  });
  detail_counts.resize(window.width_px, window.height_px);
  const auto per_pixel = static_cast<float>(1 / window.pixels());
  parallel_rows(window.height_px, kDetailRowsPerChunk, [&](int y) {
    std::vector<float> gains(static_cast<std::size_t>(window.width_px));
    std::vector<float> offsets(gains.size());
    sum_row(gain, window, y, gains);
    sum_row(offset, window, y, offsets);
    subtract_base(ir16.row(y).data(), gains.data(), offsets.data(), gains.size(), per_pixel,
                  detail_counts.row(y).data());
  });
}

DetailEnhancer::DetailEnhancer(const AgcParameters& parameters, double counts_per_netd)
    : parameters_(parameters.detail),
      is_inverted_(parameters.polarity == Polarity::black_hot),
      darkest_(static_cast<float>(is_inverted_ ? 255 - parameters.white_level : parameters.black_level)),
      brightest_(static_cast<float>(is_inverted_ ? 255 - parameters.black_level : parameters.white_level)),
      counts_per_netd_(counts_per_netd) {}

void DetailEnhancer::sharpen(const Plane<std::uint16_t>& ir16, Plane<std::uint8_t>& ir8) {
  if (parameters_.gain_dn_per_netd <= 0) return;
  find_detail(ir16, parameters_.radius_px, parameters_.edge_netd * counts_per_netd_, detail_counts_);
  const double sign = is_inverted_ ? -1 : 1;
  const auto levels_per_count = static_cast<float>(sign * parameters_.gain_dn_per_netd / counts_per_netd_);
  const auto noise_counts = static_cast<float>(parameters_.noise_netd * counts_per_netd_);
  parallel_rows(ir16.height_px(), kDetailRowsPerChunk, [&](int y) {
    add_detail(ir16.row(y).data(), detail_counts_.row(y).data(), ir8.row(y).size(), levels_per_count,
               noise_counts, darkest_, brightest_, ir8.row(y).data());
  });
}

}  // namespace thermal
