#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/image.h"

namespace thermal {

/// Depths from here on mean that there is no surface.
inline constexpr float kSkyFromM = 1e9F;

/// What Blender and our engine write there.
inline constexpr float kSkyDepthM = 1e10F;

/// Planes that a conversion needs besides the object index.
struct PassNeeds {
  bool depth = false;
  bool normals = false;
  bool actors = false;          ///< the manifest's actor_layer
  bool mirrored = false;        ///< what water mirrors
  bool depth_if_there = false;  ///< depth for labels, if the passes have it
};

/// What level water mirrors, at the water's pixels or samples: the view of the camera mirrored in the water's surface,
/// of everything above the water. Elsewhere, and where water mirrors the sky, both indices are 0. `Of` is a plane or a
/// list. All are empty if water mirrors nothing but sky.
template <template <typename> typename Of>
struct Mirrored {
  Of<std::uint16_t> object_index;
  Of<std::uint16_t> material_index;
  Of<float> depth_m;  ///< along the axis of the camera below: camera, water, and what it mirrors
  std::array<Of<float>, 3> normal;  ///< x, y, z in world axes

  [[nodiscard]] bool empty() const noexcept { return object_index.empty(); }
};
/// Samples of those pixels that have samples of their own, one pixel after another.
template <typename Value>
using SampleList = std::vector<Value>;

/// One of the objects that share a pixel, and the fraction of the pixel it covers.
struct CoverageRank {
  Plane<std::uint16_t> object_index;
  Plane<float> coverage;  ///< 0 to 1
};

/// Additional samples of some pixels of a frame, factor x factor each, at other positions than pixel centres. Pixels
/// are in rows, from left to right. Samples follow pixel row by pixel row; each has `factor` lines, with the samples of
/// all its pixels from left to right. Lists that were not requested are empty.
struct FineSamples {
  int factor = 1;                           ///< 1: no pixel has more than one sample
  std::vector<std::size_t> row_begin;       ///< [rows + 1]: where the pixels of a row begin in `x_px`
  std::vector<std::uint16_t> x_px;          ///< of the pixels
  std::vector<std::uint16_t> object_index;  ///< of the samples, like all that follow
  std::vector<std::uint16_t> material_index;
  std::vector<std::uint16_t> actor_index;
  std::vector<float> depth_m;
  std::array<std::vector<float>, 3> normal;
  Mirrored<SampleList> mirrored;

  /// Position of the first sample of a line of a pixel row.
  [[nodiscard]] std::size_t line_begin(int row, int line) const noexcept {
    const auto side = static_cast<std::size_t>(factor);
    return side * (side * row_begin[static_cast<std::size_t>(row)] +
                   static_cast<std::size_t>(line) * pixels_in(row));
  }
  /// How many of a row's pixels have samples here.
  [[nodiscard]] std::size_t pixels_in(int row) const noexcept {
    return row_begin[static_cast<std::size_t>(row) + 1] - row_begin[static_cast<std::size_t>(row)];
  }
};

/// The planes of one rendered frame, all of one size; planes that were not requested are empty.
struct Passes {
  Plane<std::uint16_t> object_index;
  Plane<std::uint16_t> material_index;  ///< empty if absent from the file
  Plane<std::uint16_t> actor_index;     ///< of actors alone, hidden only by each other; empty if absent
  Plane<float> depth_m;                 ///< along the camera's axis, not along the ray; sky: 1e9 or more
  std::array<Plane<float>, 3> normal;   ///< x, y, z in world axes
  Mirrored<Plane> mirrored;
  /// For files that list the objects sharing a pixel: radiance is the mean over these, the rest of a pixel is sky, and
  /// `object_index` is the object that covers most of it. Empty: each pixel is one object.
  std::vector<CoverageRank> ranks;
  /// Of adaptively sampled passes: the planes above then have one sample per pixel of the camera, and these samples
  /// replace those of their pixels.
  FineSamples fine;
};

/// Expands a plane of adaptively sampled passes to factor x factor values a pixel: its own samples, a list of `fine`,
/// or its value repeated. An empty plane stays empty.
[[nodiscard]] Plane<std::uint16_t> filled_in(const Plane<std::uint16_t>& pixels,
                                             const std::vector<std::uint16_t>& samples,
                                             const FineSamples& fine);
/// The same of floats.
[[nodiscard]] Plane<float> filled_in(const Plane<float>& pixels, const std::vector<float>& samples,
                                     const FineSamples& fine);

/// All planes expanded, without `fine`.
[[nodiscard]] Passes filled_in(const Passes& passes);

/// Which pixels have samples of their own: 1 there, 0 elsewhere, of the expanded size.
[[nodiscard]] Plane<std::uint16_t> sampled_mask(const FineSamples& fine, int width_px);

/// The reverse: planes with factor x factor samples a pixel become those with one, and samples of the pixels for which
/// `sampled` is not 0. Only the upper left sample of a pixel counts, in `sampled` and where a pixel keeps one. Sides are
/// multiples of the factor.
[[nodiscard]] Passes separated(const Passes& full, const Plane<std::uint16_t>& sampled, int factor);

}  // namespace thermal
