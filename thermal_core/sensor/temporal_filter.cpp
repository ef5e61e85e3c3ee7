#include "sensor/temporal_filter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "base/clones.h"
#include "base/parallel.h"

namespace thermal {
namespace {

constexpr std::size_t kFilteredPixelsAChunk = 16384;
constexpr std::size_t kFilteredRowsAChunk = 32;

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
  parallel_rows(signal_w_m2_sr.height_px(), kFilteredRowsAChunk,
                [&](int y) { follow_row(y, signal_w_m2_sr); });
}

void TemporalFilter::take_changes(const Plane<float>& signal_w_m2_sr) {
  change_.resize(signal_w_m2_sr.width_px(), signal_w_m2_sr.height_px());
  const auto signal = signal_w_m2_sr.pixels();
  const auto change = change_.pixels();
  parallel_for(signal.size(), kFilteredPixelsAChunk, [&](std::size_t begin, std::size_t end) {
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

}  // namespace thermal
