#include "sensor/optics/optics.h"

#include <algorithm>
#include <cassert>

#include "base/parallel.h"
#include "sensor/optics/psf.h"
#include "sensor/vector_math.h"

namespace thermal {
namespace {

constexpr std::size_t kRoundRowsPerChunk = 16;

/// Parity of a pattern under mirroring.
enum class Parity { even, odd };

bool is_outside(int at, int size) { return at < 0 || at >= size; }

/// Sign of a mirrored picture's values at `at`.
float sign_at(int at, int size, Parity parity) {
  return parity == Parity::odd && is_outside(at, size) ? -1.0F : 1.0F;
}

}  // namespace

/// Sums (or differences) of the rows at some distance above and below one, with mirrored margins.
class RoundConvolution::RowSums {
 public:
  RowSums(int width_px, int margin_px)
      : width_px_(width_px),
        margin_px_(margin_px),
        row_(static_cast<std::size_t>(width_px + 2 * margin_px)) {}

  /// `across` and `down` are the parities of the plane's pattern; the rows are subtracted if `down` is odd.
  void set(const Plane<float>& plane, int y, int distance, Parity across, Parity down) {
    const int height = plane.height_px();
    float* const middle = row_.data() + margin_px_;
    if (distance == 0) {
      std::ranges::copy(plane.row(y), middle);
    } else {
      const float above = (down == Parity::odd ? -1.0F : 1.0F) * sign_at(y - distance, height, down);
      set_sum(
          plane.row(mirrored(y - distance, height)), above, plane.row(mirrored(y + distance, height)),
          sign_at(y + distance, height, down),
          std::span(row_).subspan(static_cast<std::size_t>(margin_px_), static_cast<std::size_t>(width_px_)));
    }
    for (int i = 1; i <= margin_px_; ++i) {
      middle[-i] = sign_at(-i, width_px_, across) * middle[mirrored(-i, width_px_)];
      const int right = width_px_ - 1 + i;
      middle[right] = sign_at(right, width_px_, across) * middle[mirrored(right, width_px_)];
    }
  }

  /// `count` columns from x on.
  [[nodiscard]] std::span<const float> at(int x, std::size_t count) const noexcept {
    return std::span(row_).subspan(static_cast<std::size_t>(margin_px_ + x), count);
  }

 private:
  int width_px_;
  int margin_px_;
  std::vector<float> row_;
};

namespace {

/// Convolves a picture's rows with an even kernel.
template <typename Sums>
void convolve_row(const Plane<float>& picture, int y, const QuadrantKernel& kernel, Sums& sums,
                  std::span<float> out) {
  for (int down = 0; down <= kernel.radius; ++down) {
    sums.set(picture, y, down, Parity::even, Parity::even);
    const float weight = kernel.at(0, down);
    if (down == 0) set_scaled(sums.at(0, out.size()), weight, out);
    if (down > 0 && weight != 0) add_scaled(sums.at(0, out.size()), weight, out);
    for (int right = 1; right <= kernel.radius; ++right) {
      if (kernel.at(right, down) == 0) continue;
      add_sum(sums.at(-right, out.size()), sums.at(right, out.size()), kernel.at(right, down), out);
    }
  }
}

}  // namespace

void RoundConvolution::find_extents(const SubpixelDetail& detail) {
  extents_.assign(static_cast<std::size_t>(detail.across.height_px()), {});
  const auto is_set = [&detail](int x, int y) {
    return detail.across.at(x, y) != 0 || detail.down.at(x, y) != 0 || detail.crossed.at(x, y) != 0;
  };
  parallel_for(extents_.size(), kRoundRowsPerChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row) {
      const auto y = static_cast<int>(row);
      Extent extent = {.begin = 0, .end = detail.across.width_px()};
      while (extent.begin < extent.end && !is_set(extent.begin, y)) ++extent.begin;
      while (extent.end > extent.begin && !is_set(extent.end - 1, y)) --extent.end;
      extents_[row] = extent;
    }
  });
}

/// Columns of a row that are affected by detail of the rows around it.
RoundConvolution::Extent RoundConvolution::extent_around(int y) const {
  if (extents_.empty()) return {};
  const int reach = kernel_.across.radius;
  const int width = out_.width_px();
  Extent all = {.begin = width, .end = 0};
  for (int row = std::max(0, y - reach); row <= std::min(out_.height_px() - 1, y + reach); ++row) {
    const Extent& extent = extents_[static_cast<std::size_t>(row)];
    if (extent.begin == extent.end) continue;
    all.begin = std::min(all.begin, std::max(0, extent.begin - reach));
    all.end = std::max(all.end, std::min(width, extent.end + reach));
  }
  return all.begin < all.end ? all : Extent{};
}

void RoundConvolution::make_halo(const Plane<float>& picture) {
  const auto blocks_in = [](int px) { return (px + kHaloBlockPx - 1) / kHaloBlockPx; };
  const int columns = blocks_in(picture.width_px());
  const int rows = blocks_in(picture.height_px());
  blocks_.resize(columns, rows);
  halo_.resize(columns, rows);
  parallel_for(static_cast<std::size_t>(rows), kRoundRowsPerChunk, [&](std::size_t begin, std::size_t end) {
    std::vector<float> sums(static_cast<std::size_t>(columns * kHaloBlockPx));
    for (auto row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      std::ranges::fill(sums, 0.0F);
      for (int line = 0; line < kHaloBlockPx; ++line) {
        const auto in = picture.row(mirrored(row * kHaloBlockPx + line, picture.height_px()));
        add_scaled(in, 1.0F / (kHaloBlockPx * kHaloBlockPx), std::span(sums).first(in.size()));
      }
      for (int x = picture.width_px(); x < columns * kHaloBlockPx; ++x)
        sums[static_cast<std::size_t>(x)] = sums[static_cast<std::size_t>(mirrored(x, picture.width_px()))];
      const auto out = blocks_.row(row);
      for (std::size_t block = 0; block < out.size(); ++block) {
        const float* const four = sums.data() + kHaloBlockPx * block;
        out[block] = (four[0] + four[1]) + (four[2] + four[3]);
      }
    }
  });
  parallel_for(static_cast<std::size_t>(rows), kRoundRowsPerChunk, [&](std::size_t begin, std::size_t end) {
    RowSums sums(columns, kernel_.halo.radius);
    for (auto row = static_cast<int>(begin); row < static_cast<int>(end); ++row)
      convolve_row(blocks_, row, kernel_.halo, sums, halo_.row(row));
  });
}

void RoundConvolution::add_detail(const SubpixelDetail& detail, int y, RowSums& sums,
                                  std::span<float> out) const {
  const Extent extent = extent_around(y);
  const auto count = static_cast<std::size_t>(extent.end - extent.begin);
  if (count == 0) return;
  const std::span<float> from = out.subspan(static_cast<std::size_t>(extent.begin), count);
  const auto at = [&](int offset) { return sums.at(extent.begin + offset, count); };
  const QuadrantKernel& across = kernel_.across;
  for (int down = 0; down <= across.radius; ++down) {
    sums.set(detail.across, y, down, Parity::odd, Parity::even);
    for (int right = 1; right <= across.radius; ++right)
      add_difference(at(right), at(-right), across.at(right, down), from);
  }
  for (int down = 1; down <= across.radius; ++down) {
    sums.set(detail.down, y, down, Parity::even, Parity::odd);
    add_scaled(at(0), across.at(down, 0), from);
    for (int right = 1; right <= across.radius; ++right)
      add_sum(at(right), at(-right), across.at(down, right), from);
    sums.set(detail.crossed, y, down, Parity::odd, Parity::odd);
    for (int right = 1; right <= across.radius; ++right)
      add_difference(at(right), at(-right), kernel_.crossed.at(right, down), from);
  }
}

/// Interpolates linearly between the middles of blocks; constant beyond the outermost ones.
void RoundConvolution::add_halo(int y, std::vector<float>& blocks, std::span<float> out) const {
  const auto place = [](int px) { return (static_cast<float>(px) + 0.5F) / kHaloBlockPx - 0.5F; };
  const float at = place(y % kHaloBlockPx);
  const int row = y / kHaloBlockPx;
  const auto last = halo_.height_px() - 1;
  const auto here = halo_.row(row);
  const auto beside = halo_.row(std::clamp(row + (at < 0 ? -1 : 1), 0, last));
  const float share = at < 0 ? -at : at;
  blocks.resize(here.size() + 2);
  set_sum(here, 1 - share, beside, share, std::span(blocks).subspan(1, here.size()));
  blocks.front() = blocks[1];
  blocks.back() = blocks[here.size()];
  for (int phase = 0; phase < kHaloBlockPx; ++phase) {
    const float across = place(phase);
    const float of_beside = across < 0 ? -across : across;
    const float* const middle = blocks.data() + 1;
    const float* const other = middle + (across < 0 ? -1 : 1);
    const auto first = static_cast<std::size_t>(phase);
    for (std::size_t x = first, block = 0; x < out.size(); x += kHaloBlockPx, ++block)
      out[x] += (1 - of_beside) * middle[block] + of_beside * other[block];
  }
}

void RoundConvolution::apply(const SubpixelDetail& detail, Plane<float>& picture) {
  if (picture.empty()) return;
  assert(detail.empty() || detail.across.size() == picture.size());
  out_.resize(picture.width_px(), picture.height_px());
  extents_.clear();
  if (!detail.empty() && kernel_.across.radius > 0) find_extents(detail);
  make_halo(picture);
  const auto rows = static_cast<std::size_t>(picture.height_px());
  parallel_for(rows, kRoundRowsPerChunk, [&](std::size_t begin, std::size_t end) {
    RowSums sums(picture.width_px(), kernel_.pixel.radius);
    std::vector<float> blocks;
    for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      convolve_row(picture, y, kernel_.pixel, sums, out_.row(y));
      add_detail(detail, y, sums, out_.row(y));
      add_halo(y, blocks, out_.row(y));
    }
  });
  std::swap(picture, out_);
}

namespace {

std::variant<Convolution, RoundConvolution> convolution_of(const OpticsParameters& optics,
                                                           const SpectralResponse& response,
                                                           const PixelSampling& sampling) {
  if (optics.psf == Psf::gaussian) return Convolution(gaussian_psf(optics.blur_sigma_px));
  return RoundConvolution(round_kernel(optics, response, sampling));
}

}  // namespace

Optics::Optics(const OpticsParameters& optics, const SpectralResponse& response,
               const PixelSampling& sampling)
    : convolution_(convolution_of(optics, response, sampling)) {}

void Optics::apply(const SubpixelDetail& detail, Plane<float>& picture) {
  if (auto* const separable = std::get_if<Convolution>(&convolution_)) {
    separable->apply(picture);
  } else {
    std::get<RoundConvolution>(convolution_).apply(detail, picture);
  }
}

}  // namespace thermal
