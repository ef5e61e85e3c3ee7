#include "scene/seen_ground.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/parallel.h"

namespace thermal {
namespace {

constexpr double kMarginCells = 4;
constexpr double kMarginPixels = 3;
constexpr std::size_t kTileBlocks = 16;
constexpr float kUnseen = std::numeric_limits<float>::infinity();

using Point = std::array<double, 3>;

/// Bounding sphere of what some squares of the ground hold.
struct Ball {
  Point middle_m{};
  double radius_m = 0;
};

/// Minimum and maximum of some heights.
struct HeightRange {
  double low_m = std::numeric_limits<double>::infinity();
  double high_m = -std::numeric_limits<double>::infinity();

  void add(float height_m) noexcept {
    low_m = std::min(low_m, static_cast<double>(height_m));
    high_m = std::max(high_m, static_cast<double>(height_m));
  }
};

/// The view of a camera.
class Sight {
 public:
  Sight(const CameraIntrinsics& camera, const std::array<double, 2>& depth_range_m) noexcept
      : depth_range_m_(depth_range_m), pixel_width_(1 / std::sqrt(camera.fx_px * camera.fy_px)) {
    // A point (x, y, z) is on the inner side where across * x or y + deeper * z >= 0.
    const auto side = [](double sign, double border) {
      const double length = std::sqrt(1 + border * border);
      return Side{.across = sign / length, .deeper = -sign * border / length};
    };
    sides_ = {
        side(1, -camera.cx_px / camera.fx_px), side(-1, (camera.width_px - camera.cx_px) / camera.fx_px),
        side(1, -camera.cy_px / camera.fy_px), side(-1, (camera.height_px - camera.cy_px) / camera.fy_px)};
  }

  /// Width of the finest pixel [m] that may use a value in a sphere.
  [[nodiscard]] double pixel_m(const std::array<double, 16>& pose, const Ball& ball) const noexcept {
    const Point from_m = {ball.middle_m[0] - pose[3], ball.middle_m[1] - pose[7],
                          ball.middle_m[2] - pose[11]};
    const auto along = [&](std::size_t axis) {
      return pose[axis] * from_m[0] + pose[4 + axis] * from_m[1] + pose[8 + axis] * from_m[2];
    };
    const double depth_m = along(2);
    const double reach_m = ball.radius_m + kMarginPixels * pixel_width_ * std::max(0.0, depth_m);
    bool inside = depth_m + reach_m > depth_range_m_[0] && depth_m - reach_m < depth_range_m_[1];
    for (std::size_t k = 0; inside && k < sides_.size(); ++k)
      inside = sides_[k].across * along(k / 2) + sides_[k].deeper * depth_m > -reach_m;
    return inside ? pixel_width_ * std::max(0.0, depth_m - reach_m) : std::numeric_limits<double>::infinity();
  }

 private:
  /// A plane through the camera and a side of its picture, as a normal in camera axes.
  struct Side {
    double across = 0;  ///< of x for the left and the right one, of y for the others
    double deeper = 0;
  };

  std::array<double, 2> depth_range_m_;
  double pixel_width_;
  std::array<Side, 4> sides_;
};

/// Heights of each surface that mirrors.
std::vector<HeightRange> waters_of(const BakedScene& scene) {
  const MirrorIndices mirrors(scene);
  std::vector<HeightRange> waters;
  for (const BakedSurface& surface : scene.surfaces) {
    const BakedMesh& mesh = scene.meshes[surface.mesh];
    HeightRange range;
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
      if (!mirrors.has(surface.object, mesh.material_index[k])) continue;
      for (const std::uint32_t corner : mesh.triangles[k]) range.add(mesh.points_m[corner][2]);
    }
    if (range.low_m <= range.high_m) waters.push_back(range);
  }
  return waters;
}

/// Tests bounding spheres of the ground's squares against views.
class SeenGround {
 public:
  SeenGround(const BakedScene& scene, const GroundMaps& maps, std::span<const GroundView> views)
      : maps_(maps), views_(views), waters_(waters_of(scene)) {
    for (const GroundView& view : views) sights_.emplace_back(view.camera, scene.depth_range_m);
  }

  /// Visits a tile of blocks from (row, column) on.
  void visit_tile(std::size_t row, std::size_t column, std::vector<float>& pixels_m) const {
    const std::size_t side = blocks_along(maps_.cells);
    const std::size_t rows = std::min(kTileBlocks, side - row);
    const std::size_t columns = std::min(kTileBlocks, side - column);
    const std::vector<Ball> tile = balls_of(row, column, std::max(rows, columns));
    std::vector<std::vector<Ball>> blocks;
    for (std::size_t k = 0; k < rows * columns; ++k)
      blocks.push_back(balls_of(row + k / columns, column + k % columns, 1));
    for (std::size_t view = 0; view < views_.size(); ++view) {
      for (const auto& pose : views_[view].camera_to_world) {
        if (finest_m(sights_[view], pose, tile) == kUnseen) continue;
        for (std::size_t k = 0; k < blocks.size(); ++k) {
          float& pixel_m = pixels_m[(row + k / columns) * side + column + k % columns];
          pixel_m = std::min(pixel_m, finest_m(sights_[view], pose, blocks[k]));
        }
      }
    }
  }

 private:
  static float finest_m(const Sight& sight, const std::array<double, 16>& pose,
                        const std::vector<Ball>& balls) noexcept {
    double finest_m = std::numeric_limits<double>::infinity();
    for (const Ball& ball : balls) finest_m = std::min(finest_m, sight.pixel_m(pose, ball));
    return static_cast<float>(finest_m);
  }

  /// Bounding spheres of a square of blocks, and of its mirror image in each water.
  [[nodiscard]] std::vector<Ball> balls_of(std::size_t row, std::size_t column, std::size_t blocks) const {
    const double cell_m = maps_.size_m / static_cast<double>(maps_.cells);
    const double half_m = cell_m * static_cast<double>(blocks * kBlockCells) / 2;
    const HeightRange heights = heights_of(row * kBlockCells, column * kBlockCells, blocks * kBlockCells);
    const auto ball = [&](double z_m, double half_height_m) {
      const auto from_corner_m = [&](std::size_t block) {
        return cell_m * static_cast<double>(block * kBlockCells) - maps_.size_m / 2 + half_m;
      };
      return Ball{
          .middle_m = {from_corner_m(column), from_corner_m(row), z_m},
          .radius_m = std::sqrt(2 * half_m * half_m + half_height_m * half_height_m) + kMarginCells * cell_m};
    };
    const double z_m = (heights.low_m + heights.high_m) / 2;
    const double half_height_m = (heights.high_m - heights.low_m) / 2;
    std::vector<Ball> balls = {ball(z_m, half_height_m)};
    for (const HeightRange& water : waters_)
      balls.push_back(ball(water.low_m + water.high_m - z_m, half_height_m + water.high_m - water.low_m));
    return balls;
  }

  /// Heights of cells and of their neighbours, because the ground is interpolated between cells.
  [[nodiscard]] HeightRange heights_of(std::size_t row, std::size_t column,
                                       std::size_t cells) const noexcept {
    HeightRange range;
    const auto first = [](std::size_t number) { return number == 0 ? 0 : number - 1; };
    const auto end = [&](std::size_t number) { return std::min(maps_.cells, number + cells + 1); };
    for (std::size_t y = first(row); y < end(row); ++y)
      for (std::size_t x = first(column); x < end(column); ++x)
        range.add(maps_.height_m[y * maps_.cells + x]);
    return range;
  }

  const GroundMaps& maps_;
  std::span<const GroundView> views_;
  std::vector<HeightRange> waters_;
  std::vector<Sight> sights_;
};

}  // namespace

std::vector<float> finest_pixels_m(const BakedScene& scene, const GroundMaps& maps,
                                   std::span<const GroundView> views) {
  const std::size_t side = blocks_along(maps.cells);
  const std::size_t tiles = (side + kTileBlocks - 1) / kTileBlocks;
  std::vector<float> pixels_m(side * side, kUnseen);
  const SeenGround ground(scene, maps, views);
  parallel_for(tiles * tiles, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t tile = begin; tile < end; ++tile)
      ground.visit_tile(tile / tiles * kTileBlocks, tile % tiles * kTileBlocks, pixels_m);
  });
  return pixels_m;
}

}  // namespace thermal
