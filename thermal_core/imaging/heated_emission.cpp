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

/// The cover of each surface; -1: none.
std::vector<std::int32_t> covers_of(const std::vector<HeatedSurface>& surfaces) {
  std::vector<std::int32_t> covers;
  for (const HeatedSurface& surface : surfaces)
    covers.push_back(surface.kind == HeatedSurface::Kind::cover ? surface.cover : -1);
  return covers;
}

/// The emission of one scene's surfaces.
class HeatedEmission {
 public:
  HeatedEmission(std::vector<HeatedSurface> surfaces,
                 const std::vector<std::unique_ptr<RadianceTable>>& tables, const GroundTemperatures* ground,
                 const WarmSpots& spots, const VariationField& field)
      : surfaces_(std::move(surfaces)),
        ground_(ground),
        spots_(spots),
        field_(field),
        ones_(surfaces_.size(), 1.0F),
        cover_(covers_of(surfaces_)),
        hot_(!spots.empty()) {
    std::vector<std::int32_t> first_node;
    for (const auto& table : tables) {
      first_node.push_back(static_cast<std::int32_t>(nodes_.size()));
      table->append_nodes(nodes_);
    }
    for (const HeatedSurface& surface : surfaces_) {
      even_k_.push_back(surface.temperature_k);
      rate_k_h_.push_back(surface.rate_k_h);
      stddev_k_.push_back(surface.variation_stddev_k);
      varies_ = varies_ || surface.variation_stddev_k > 0;
      per_length_.push_back(surface.per_correlation_length);
      table_.push_back(tables.at(surface.table).get());
      hot_ = hot_ || surface.temperature_k >= RadianceTable::kHottest;
      first_node_.push_back(first_node.at(surface.table));
    }
  }

  void operator()(Row& row) const {
    const std::size_t width = row.surface.size();
    for (auto* scratch : {&row.place_x, &row.place_y, &row.footprint, &row.variation, &row.temperature_k,
                          &row.metres[0], &row.metres[1], &row.metres[2]})
      scratch->resize(width);
    kernels::look_up(row.surface.data(), even_k_.data(), row.temperature_k.data(), width);
    if (ground_ != nullptr || varies_) find_places(row);
    if (ground_ != nullptr) {
      ground_->sample({.surface = row.surface,
                       .cover_of_surface = cover_,
                       .x_m = row.metres[0],
                       .y_m = row.metres[1],
                       .footprint_m = row.metres[2]},
                      row.temperature_k);
      spots_.add(row.surface, cover_, row.metres[0], row.metres[1], row.temperature_k);
    }
    add_bodies_and_crowns(row);
    if (varies_) {
      kernels::unsettle({.surface = row.surface.data(),
                         .per_correlation_length = per_length_.data(),
                         .x_m = row.metres[0].data(),
                         .y_m = row.metres[1].data(),
                         .footprint_m = row.metres[2].data()},
                        row.place_x.data(), row.place_y.data(), row.footprint.data(), width);
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
    if (hot_) emit_hot(row);
  }

 private:
  /// Where the tables end.
  void emit_hot(Row& row) const {
    for (std::size_t i = 0; i < row.surface.size(); ++i) {
      if (row.temperature_k[i] >= RadianceTable::kHottest)
        row.radiance_w_m2_sr[i] = table_[row.surface[i]]->radiance(row.temperature_k[i]);
    }
  }

  void find_places(Row& row) const {
    kernels::find_places({.surface = row.surface.data(),
                          .per_correlation_length = ones_.data(),
                          .depth_m = row.depth_m.data(),
                          .ray_x = row.ray_x.data(),
                          .ray_y = row.ray_y.data(),
                          .origin_x_m = row.pose->position_m[0],
                          .origin_y_m = row.pose->position_m[1],
                          .x = world_axis(row, 0),
                          .y = world_axis(row, 1),
                          .pixel_width = row.sample_width},
                         row.metres[0].data(), row.metres[1].data(), row.metres[2].data(),
                         row.surface.size());
  }

  /// Runs of pixels of one surface.
  void add_bodies_and_crowns(Row& row) const {
    const std::size_t width = row.surface.size();
    for (std::size_t begin = 0; begin < width;) {
      const std::uint16_t number = row.surface[begin];
      std::size_t end = begin + 1;
      while (end < width && row.surface[end] == number) ++end;
      const HeatedSurface& surface = surfaces_[number];
      if (surface.kind == HeatedSurface::Kind::oriented) face(surface, row, begin, end);
      if (surface.kind == HeatedSurface::Kind::crown) add_depths(surface, row, begin, end);
      begin = end;
    }
  }

  static void face(const HeatedSurface& surface, Row& row, std::size_t begin, std::size_t end) {
    kernels::warm_by_normal({.nx = row.normal[0].data() + begin,
                             .ny = row.normal[1].data() + begin,
                             .nz = row.normal[2].data() + begin,
                             .ray_x = row.ray_x.data() + begin,
                             .ray_y = row.ray_y.data() + begin,
                             .x = world_axis(row, 0),
                             .y = world_axis(row, 1),
                             .z = world_axis(row, 2),
                             .steepest = surface.steepest,
                             .sun = surface.sun,
                             .coefficients = surface.by_normal},
                            row.temperature_k.data() + begin, end - begin);
  }

  void add_depths(const HeatedSurface& surface, Row& row, std::size_t begin, std::size_t end) const {
    const kernels::CameraAxis up = world_axis(row, 2);
    for (std::size_t i = begin; i < end; ++i) {
      if (!(row.depth_m[i] > 0 && row.depth_m[i] < kSkyFromM)) continue;
      const float from_z_m = row.origin_z_m.empty() ? row.pose->position_m[2] : row.origin_z_m[i];
      const float z_m = from_z_m + row.depth_m[i] * along(up, row, i);
      row.temperature_k[i] = by_depth_k(surface, crown_top_m(row, i) - z_m);
    }
  }

  [[nodiscard]] float crown_top_m(const Row& row, std::size_t i) const {
    return ground_->crown_top_m(row.metres[0][i], row.metres[1][i]);
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
  const WarmSpots& spots_;
  const VariationField& field_;
  std::vector<float> nodes_;
  // By surface, as the kernels read them:
  std::vector<float> ones_;
  std::vector<std::int32_t> cover_;
  std::vector<float> even_k_;
  std::vector<float> rate_k_h_;
  std::vector<float> stddev_k_;
  std::vector<float> per_length_;
  std::vector<std::int32_t> first_node_;
  std::vector<const RadianceTable*> table_;
  bool varies_ = false;  ///< any of them
  bool hot_ = false;     ///< something may be hotter than the tables
};

}  // namespace

RowTerm heated_emission(std::vector<HeatedSurface> surfaces,
                        const std::vector<std::unique_ptr<RadianceTable>>& tables,
                        const GroundTemperatures* ground, const WarmSpots& spots,
                        const VariationField& field) {
  return HeatedEmission(std::move(surfaces), tables, ground, spots, field);
}

RowTerm mapped_sky_view(const std::vector<HeatedSurface>& surfaces, const GroundTemperatures& ground) {
  return [&ground, cover = covers_of(surfaces)](Row& row) {
    ground.sample_sky_view({.surface = row.surface,
                            .cover_of_surface = cover,
                            .x_m = row.metres[0],
                            .y_m = row.metres[1],
                            .footprint_m = row.metres[2]},
                           row.sky_view);
  };
}

}  // namespace thermal
