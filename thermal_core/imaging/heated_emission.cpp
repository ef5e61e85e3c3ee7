#include "imaging/heated_emission.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "imaging/row_kernels.h"

namespace thermal {
namespace {

kernels::CameraAxis world_axis(const Row& row, std::size_t axis) {
  const auto& r = row.pose->rotation.at(axis);
  return {.right = r[0], .down = r[1], .forward = r[2]};
}

float along(const kernels::CameraAxis& axis, const Row& row, std::size_t i) {
  return axis.right * row.ray_x[i] + axis.down * row.ray_y[i] + axis.forward;
}

/// The emission of one scene's surfaces.
class HeatedEmission {
 public:
  HeatedEmission(std::vector<HeatedSurface> surfaces,
                 const std::vector<std::unique_ptr<RadianceTable>>& tables, const GroundTemperatures* ground,
                 const VariationField& field)
      : surfaces_(std::move(surfaces)), ground_(ground), field_(field), ones_(surfaces_.size(), 1.0F) {
    std::vector<std::int32_t> first_node;
    for (const auto& table : tables) {
      first_node.push_back(static_cast<std::int32_t>(nodes_.size()));
      table->append_nodes(nodes_);
    }
    for (const HeatedSurface& surface : surfaces_) {
      even_k_.push_back(surface.temperature_k);
      cover_.push_back(surface.kind == HeatedSurface::Kind::cover ? surface.cover : -1);
      rate_k_h_.push_back(surface.rate_k_h);
      stddev_k_.push_back(surface.variation_stddev_k);
      varies_ = varies_ || surface.variation_stddev_k > 0;
      per_length_.push_back(surface.per_correlation_length);
      first_node_.push_back(first_node.at(surface.table));
      alone_.push_back(surface.kind == HeatedSurface::Kind::oriented ||
                       surface.kind == HeatedSurface::Kind::crown);
    }
  }

  void operator()(Row& row) const {
    const std::size_t width = row.surface.size();
    for (auto* scratch : {&row.place_x, &row.place_y, &row.footprint, &row.variation, &row.temperature_k})
      scratch->resize(width);
    kernels::look_up(row.surface.data(), even_k_.data(), row.temperature_k.data(), width);
    if (ground_ != nullptr) {
      find_places(row, ones_);
      ground_->sample({.surface = row.surface,
                       .cover_of_surface = cover_,
                       .x_m = row.place_x,
                       .y_m = row.place_y,
                       .footprint_m = row.footprint},
                      row.temperature_k);
    }
    add_bodies_and_crowns(row);
    if (varies_) {
      find_places(row, per_length_);
      kernels::unsettle(row.place_x.data(), row.place_y.data(), width);
      field_.sample(row.place_x, row.place_y, row.footprint, row.variation);
    } else {
      std::ranges::fill(row.variation, 0.0F);
    }
    kernels::emit_heated({.surface = row.surface.data(),
                          .temperature_k = row.temperature_k.data(),
                          .rate_k_h = rate_k_h_.data(),
                          .stddev_k = stddev_k_.data(),
                          .table = first_node_.data(),
                          .node_w_m2_sr = nodes_.data(),
                          .variation = row.variation.data(),
                          .later_h = row.later_h,
                          .coldest_k = RadianceTable::kColdest,
                          .nodes_per_k = RadianceTable::kNodesPerKelvin,
                          .last_node = RadianceTable::kSteps - 1},
                         row.radiance_w_m2_sr.data(), width);
  }

 private:
  static void find_places(Row& row, const std::vector<float>& per_length) {
    kernels::find_places({.surface = row.surface.data(),
                          .per_correlation_length = per_length.data(),
                          .depth_m = row.depth_m.data(),
                          .ray_x = row.ray_x.data(),
                          .ray_y = row.ray_y.data(),
                          .origin_x_m = row.pose->position_m[0],
                          .origin_y_m = row.pose->position_m[1],
                          .x = world_axis(row, 0),
                          .y = world_axis(row, 1),
                          .pixel_width = row.sample_width},
                         row.place_x.data(), row.place_y.data(), row.footprint.data(), row.surface.size());
  }

  void add_bodies_and_crowns(Row& row) const {
    const kernels::CameraAxis up = world_axis(row, 2);
    for (std::size_t i = 0; i < row.surface.size(); ++i) {
      if (!alone_[row.surface[i]]) continue;
      const HeatedSurface& surface = surfaces_[row.surface[i]];
      if (surface.kind == HeatedSurface::Kind::oriented) {
        row.temperature_k[i] = by_normal_k(surface, row, i);
      } else if (row.depth_m[i] > 0 && row.depth_m[i] < kSkyFromM) {
        const float z_m = row.pose->position_m[2] + row.depth_m[i] * along(up, row, i);
        row.temperature_k[i] = by_depth_k(surface, crown_top_m(row, i) - z_m);
      }
    }
  }

  [[nodiscard]] float crown_top_m(const Row& row, std::size_t i) const {
    return ground_->crown_top_m(row.place_x[i], row.place_y[i]);
  }

  /// Normals that face away from the camera are flipped; those that are far from unit length count as facing up.
  static float by_normal_k(const HeatedSurface& surface, const Row& row, std::size_t i) {
    float x = row.normal[0][i];
    float y = row.normal[1][i];
    float z = row.normal[2][i];
    const float norm2 = x * x + y * y + z * z;
    if (!(norm2 > 0.81F && norm2 < 1.21F)) {
      x = y = 0;
      z = 1;
    } else if (x * along(world_axis(row, 0), row, i) + y * along(world_axis(row, 1), row, i) +
                   z * along(world_axis(row, 2), row, i) >
               0) {
      x = -x;
      y = -y;
      z = -z;
    }
    const float level2 = x * x + y * y;
    if (level2 > surface.steepest * surface.steepest) {
      const float less = surface.steepest / std::sqrt(level2);
      x *= less;
      y *= less;
    }
    const auto& c = surface.by_normal;
    return c[0] + c[1] * x + c[2] * y + c[3] * z + c[4] * x * x + c[5] * y * y + c[6] * x * y + c[7] * x * z +
           c[8] * y * z;
  }

  static float by_depth_k(const HeatedSurface& surface, float depth_m) {
    constexpr float kPerM = 4;
    constexpr auto kLast = static_cast<float>(HeatedSurface::kDepths - 1);
    const float position = std::clamp(depth_m * kPerM, 0.0F, kLast - 0.001F);
    const auto node = static_cast<std::size_t>(position);
    const float from = surface.by_depth_k[node];
    return from + (position - static_cast<float>(node)) * (surface.by_depth_k[node + 1] - from);
  }

  std::vector<HeatedSurface> surfaces_;
  const GroundTemperatures* ground_;
  const VariationField& field_;
  std::vector<float> nodes_;
  // By surface, as the kernels read them:
  std::vector<float> ones_;
  std::vector<float> even_k_;
  std::vector<std::int32_t> cover_;
  std::vector<float> rate_k_h_;
  std::vector<float> stddev_k_;
  std::vector<float> per_length_;
  std::vector<std::int32_t> first_node_;
  std::vector<char> alone_;  ///< pixels are computed one by one
  bool varies_ = false;      ///< any of them
};

}  // namespace

RowTerm heated_emission(std::vector<HeatedSurface> surfaces,
                        const std::vector<std::unique_ptr<RadianceTable>>& tables,
                        const GroundTemperatures* ground, const VariationField& field) {
  return HeatedEmission(std::move(surfaces), tables, ground, field);
}

}  // namespace thermal
