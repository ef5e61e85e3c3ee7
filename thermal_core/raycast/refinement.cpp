#include "raycast/refinement.h"

#include <algorithm>
#include <cmath>

#include "base/clones.h"
#include "base/parallel.h"

namespace thermal {
namespace {

Vector3 to_world(const Transform<double>& m, const Vector3& p) noexcept {
  return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
          m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
}

/// A rectangle of pixels, without its right and bottom edges.
struct Range {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;

  [[nodiscard]] bool is_empty() const noexcept { return left >= right || top >= bottom; }
};

int clamped(double place_px, int most_px) {
  return static_cast<int>(std::clamp(place_px, 0.0, static_cast<double>(most_px)));
}

/// The pixels with directions in a range, and a margin of one pixel.
Range pixels_at(const LensRange& directions, const PixelRays& rays) {
  const LensRange seen = common(directions, rays.range());
  if (seen.is_empty()) return {};
  const auto [least, most] = distort(rays.lens(), seen);
  const CameraIntrinsics& camera = rays.camera();
  return {.left = clamped(camera.cx_px + camera.fx_px * least.x - 1, camera.width_px),
          .top = clamped(camera.cy_px + camera.fy_px * least.y - 1, camera.height_px),
          .right = clamped(camera.cx_px + camera.fx_px * most.x + 2, camera.width_px),
          .bottom = clamped(camera.cy_px + camera.fy_px * most.y + 2, camera.height_px)};
}

/// The pixels that a piece may cover; all if unknown.
Range pixels_of(const Piece& piece, const SceneAccelerator& accelerator, const View& view,
                const PixelRays& rays) {
  constexpr double kLeastDepthM = 1e-3;
  const MeshBox& box = accelerator.box(piece.mesh);
  LensRange directions;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vector3 point =
        to_world(piece.to_world, {box[corner & 1U][0], box[corner >> 1U & 1U][1], box[corner >> 2U][2]}) -
        view.position_m;
    const double depth_m = dot(point, view.forward);
    if (!(depth_m >= kLeastDepthM)) return {.right = rays.width_px(), .bottom = rays.height_px()};
    directions.add({.x = dot(point, view.right) / depth_m, .y = dot(point, view.down) / depth_m});
  }
  return pixels_at(directions, rays);
}

/// Sets `out` to 1 where a row's pixels differ from those of a neighbouring row or column; never clears it.
VELDT_CLONES void mark_differing(const std::uint16_t* a, const std::uint16_t* b, std::uint8_t* out_a,
                                 std::uint8_t* out_b, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t differs = a[i] != b[i] ? 1 : 0;
    out_a[i] |= differs;
    out_b[i] |= differs;
  }
}

VELDT_CLONES void mark_differing(const float* a, const float* b, std::uint8_t* out_a, std::uint8_t* out_b,
                                 std::size_t count) noexcept {
  constexpr float kShare = 0.02F;
  for (std::size_t i = 0; i < count; ++i) {
    const float least = a[i] < b[i] ? a[i] : b[i];
    const std::uint8_t differs = std::abs(a[i] - b[i]) > kShare * least ? 1 : 0;
    out_a[i] |= differs;
    out_b[i] |= differs;
  }
}

/// Compares a row with a neighbouring row, or with itself, shifted by -1 to 1 pixels.
template <typename T>
void mark_pairs(const Plane<T>& plane, int row, int other, int shift, Plane<std::uint8_t>& marks) {
  const auto count = static_cast<std::size_t>(plane.width_px() - std::abs(shift));
  const std::size_t from = shift < 0 ? 1U : 0U;
  const std::size_t to = shift > 0 ? 1U : 0U;
  mark_differing(plane.row(row).data() + from, plane.row(other).data() + to, marks.row(row).data() + from,
                 marks.row(other).data() + to, count);
}

void mark_pairs(const Passes& passes, int row, int other, int shift, Plane<std::uint8_t>& marks) {
  mark_pairs(passes.object_index, row, other, shift, marks);
  mark_pairs(passes.material_index, row, other, shift, marks);
  mark_pairs(passes.depth_m, row, other, shift, marks);
  if (passes.mirrored.empty()) return;
  mark_pairs(passes.mirrored.object_index, row, other, shift, marks);
  mark_pairs(passes.mirrored.material_index, row, other, shift, marks);
}

}  // namespace

Plane<std::uint8_t> pixels_near(const std::vector<Piece>& pieces, const SceneAccelerator& accelerator,
                                const View& view, const PixelRays& rays) {
  Plane<std::uint8_t> near(rays.width_px(), rays.height_px());
  for (const Piece& piece : pieces) {
    const Range range = pixels_of(piece, accelerator, view, rays);
    for (int y = range.top; y < range.bottom; ++y)
      std::fill(near.row(y).begin() + range.left, near.row(y).begin() + range.right, std::uint8_t{1});
  }
  return near;
}

bool may_see(const std::vector<Piece>& pieces, const SceneAccelerator& accelerator, const View& view,
             const PixelRays& rays) {
  return std::ranges::any_of(
      pieces, [&](const Piece& piece) { return !pixels_of(piece, accelerator, view, rays).is_empty(); });
}

void choose_pixels(const Passes& passes, const Plane<std::uint8_t>& near_actors, FineSamples& fine) {
  Plane<std::uint8_t> marks = near_actors;
  const int height = marks.height_px();
  for (int y = 0; y < height; ++y) {
    mark_pairs(passes, y, y, 1, marks);
    for (int shift = -1; shift <= 1 && y + 1 < height; ++shift) mark_pairs(passes, y, y + 1, shift, marks);
  }
  fine.row_begin.assign(1, 0);
  fine.x_px.clear();
  for (int y = 0; y < height; ++y) {
    const auto row = marks.row(y);
    for (std::size_t x = 0; x < row.size(); ++x)
      if (row[x] != 0) fine.x_px.push_back(static_cast<std::uint16_t>(x));
    fine.row_begin.push_back(fine.x_px.size());
  }
}

}  // namespace thermal
