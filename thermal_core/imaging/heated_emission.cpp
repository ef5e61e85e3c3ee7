#include "imaging/heated_emission.h"

#include <algorithm>
#include <cmath>
#include <cstring>
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

/// Flags of surfaces that are ground with maps: 1, others 0.
std::vector<std::int32_t> ground_among(const std::vector<HeatedSurface>& surfaces) {
  std::vector<std::int32_t> is_ground;
  for (const HeatedSurface& surface : surfaces)
    is_ground.push_back(surface.kind == HeatedSurface::Kind::ground ? 1 : 0);
  return is_ground;
}

/// The emission of one scene's surfaces during a span.
class HeatedEmission {
 public:
  HeatedEmission(const HeatSpan& span, const SceneHeat& heat,
                 const std::vector<std::unique_ptr<RadianceTable>>& tables, const VariationField& field)
      : middle_h_(static_cast<float>(span.middle_h)),
        surfaces_(span.surfaces),
        ground_(span.ground ? &*span.ground : nullptr),
        detail_(heat.ground ? &*heat.ground : nullptr),
        spots_(heat.spots),
        field_(field),
        is_ground_(ground_among(surfaces_)),
        hot_(!spots_.empty()) {
    std::vector<std::int32_t> first_node;
    for (const auto& table : tables) {
      first_node.push_back(static_cast<std::int32_t>(nodes_.size()));
      table->append_nodes(nodes_);
    }
    for (const HeatedSurface& surface : surfaces_) {
      kind_.push_back(surface.kind);
      even_k_.push_back(surface.middle.temperature_k);
      even_k_h_.push_back(surface.per_h.temperature_k);
      stddev_k_.push_back(surface.variation_stddev_k);
      varies_ = varies_ || surface.variation_stddev_k > 0;
      per_length_.push_back(surface.per_correlation_length);
      table_.push_back(tables.at(surface.table).get());
      hot_ = hot_ || surface.middle.temperature_k >= RadianceTable::kHottest;
      first_node_.push_back(first_node.at(surface.table));
    }
  }

  void operator()(Row& row) const {
    const std::size_t width = row.surface.size();
    for (auto* scratch : {&row.point_x, &row.point_y, &row.footprint, &row.variation, &row.temperature_k,
                          &row.ground_sky_view, &row.metres[0], &row.metres[1], &row.metres[2]})
      scratch->resize(width);
    row.even_k.resize(even_k_.size());
    for (std::size_t i = 0; i < even_k_.size(); ++i) row.even_k[i] = even_k_[i] + later_h(row) * even_k_h_[i];
    kernels::look_up(row.surface.data(), row.even_k.data(), row.temperature_k.data(), width);
    kernels::FootprintRange footprints;
    if (ground_ != nullptr || varies_) footprints = find_points(row);
    if (ground_ != nullptr) {
      detail_->warp.move(row.metres[0], row.metres[1], row.metres[2], row.point_x, row.point_y);
      ground_->sample({.surface = row.surface,
                       .is_ground = is_ground_,
                       .x_m = row.point_x,
                       .y_m = row.point_y,
                       .footprint_m = row.metres[2],
                       .footprints = footprints},
                      later_h(row), row.temperature_k, row.ground_sky_view);
      spots_.add(row.surface, is_ground_, row.metres[0], row.metres[1], row.temperature_k);
    }
    add_bodies_and_crowns(row);
    if (varies_) {
      kernels::unsettle({.surface = row.surface.data(),
                         .per_correlation_length = per_length_.data(),
                         .x_m = row.metres[0].data(),
                         .y_m = row.metres[1].data(),
                         .footprint_m = row.metres[2].data()},
                        row.point_x.data(), row.point_y.data(), row.footprint.data(), width);
      field_.sample(row.point_x, row.point_y, row.footprint, row.variation);
    } else {
      std::ranges::fill(row.variation, 0.0F);
    }
    kernels::emit_heated({.surface = row.surface.data(),
                          .temperature_k = row.temperature_k.data(),
                          .stddev_k = stddev_k_.data(),
                          .table = first_node_.data(),
                          .node_w_m2_sr = nodes_.data(),
                          .variation = row.variation.data(),
                          .coldest_k = RadianceTable::kColdest,
                          .nodes_per_k = RadianceTable::kNodesPerKelvin,
                          .last_node = RadianceTable::kSteps - 1},
                         row.radiance_w_m2_sr.data(), width);
    if (hot_) emit_hot(row);
  }

 private:
  /// Offset of a frame from the middle of the span [h].
  [[nodiscard]] float later_h(const Row& row) const noexcept { return row.later_h - middle_h_; }

  /// Emission beyond the range of the tables.
  void emit_hot(Row& row) const {
    for (std::size_t i = 0; i < row.surface.size(); ++i) {
      if (row.temperature_k[i] >= RadianceTable::kHottest)
        row.radiance_w_m2_sr[i] = table_[row.surface[i]]->radiance(row.temperature_k[i]);
    }
  }

  static kernels::FootprintRange find_points(Row& row) {
    return kernels::find_metres({.depth_m = row.depth_m.data(),
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
      const std::size_t end = end_of_run(row.surface, begin);
      if (kind_[number] == HeatedSurface::Kind::oriented) face(surfaces_[number], row, begin, end);
      if (kind_[number] == HeatedSurface::Kind::crown) add_depths(surfaces_[number], row, begin, end);
      if (kind_[number] == HeatedSurface::Kind::water) add_waters(surfaces_[number], row, begin, end);
      begin = end;
    }
  }

  /// Compares four pixels at a time, then one by one.
  static std::size_t end_of_run(std::span<const std::uint16_t> surface, std::size_t begin) {
    constexpr std::uint64_t kEach = 0x0001000100010001;
    const std::uint64_t all_alike = kEach * surface[begin];
    std::size_t end = begin + 1;
    for (std::uint64_t four = 0; end + 4 <= surface.size(); end += 4) {
      std::memcpy(&four, &surface[end], sizeof four);
      if (four != all_alike) break;
    }
    while (end < surface.size() && surface[end] == surface[begin]) ++end;
    return end;
  }

  void face(const HeatedSurface& surface, Row& row, std::size_t begin, std::size_t end) const {
    kernels::FacingInput facing = {.nx = row.normal[0].data() + begin,
                                   .ny = row.normal[1].data() + begin,
                                   .nz = row.normal[2].data() + begin,
                                   .ray_x = row.ray_x.data() + begin,
                                   .ray_y = row.ray_y.data() + begin,
                                   .x = world_axis(row, 0),
                                   .y = world_axis(row, 1),
                                   .z = world_axis(row, 2),
                                   .steepest = surface.steepest,
                                   .sun = surface.middle.sun,
                                   .coefficients = surface.middle.by_normal};
    for (std::size_t i = 0; i < facing.sun.size(); ++i) facing.sun[i] += later_h(row) * surface.per_h.sun[i];
    for (std::size_t i = 0; i < facing.coefficients.size(); ++i)
      facing.coefficients[i] += later_h(row) * surface.per_h.by_normal[i];
    kernels::warm_by_normal(facing, row.temperature_k.data() + begin, end - begin);
  }

  void add_depths(const HeatedSurface& surface, Row& row, std::size_t begin, std::size_t end) const {
    const kernels::CameraAxis up = world_axis(row, 2);
    for (std::size_t i = begin; i < end; ++i) {
      if (!(row.depth_m[i] > 0 && row.depth_m[i] < kSkyFromM)) continue;
      const float from_z_m = row.origin_z_m.empty() ? row.pose->position_m[2] : row.origin_z_m[i];
      const float z_m = from_z_m + row.depth_m[i] * along(up, row, i);
      row.temperature_k[i] = by_depth_k(surface, crown_top_m(row, i) - z_m, kCrownStepM, later_h(row));
    }
  }

  void add_waters(const HeatedSurface& surface, Row& row, std::size_t begin, std::size_t end) const {
    for (std::size_t i = begin; i < end; ++i) {
      const float depth_m = detail_->waters.at(row.metres[0][i], row.metres[1][i]);
      if (depth_m > 0) row.temperature_k[i] = by_depth_k(surface, depth_m, kWaterStepM, later_h(row));
    }
  }

  [[nodiscard]] float crown_top_m(const Row& row, std::size_t i) const {
    return detail_->crown_tops.at(row.metres[0][i], row.metres[1][i]);
  }

  static float by_depth_k(const HeatedSurface& surface, float depth_m, double step_m, float later_h) {
    constexpr auto kLast = static_cast<float>(SurfaceWarmth::kDepths - 1);
    const float position = std::clamp(depth_m * static_cast<float>(1 / step_m), 0.0F, kLast - 0.001F);
    const auto node = static_cast<std::size_t>(position);
    const auto node_k = [&](std::size_t number) {
      return surface.middle.by_depth_k[number] + later_h * surface.per_h.by_depth_k[number];
    };
    return node_k(node) + (position - static_cast<float>(node)) * (node_k(node + 1) - node_k(node));
  }

  float middle_h_;
  const std::vector<HeatedSurface>& surfaces_;
  const GroundTexture* ground_;
  const GroundDetail* detail_;
  const WarmSpots& spots_;
  const VariationField& field_;
  std::vector<float> nodes_;
  // By surface, as the kernels read them:
  std::vector<std::int32_t> is_ground_;
  std::vector<HeatedSurface::Kind> kind_;
  std::vector<float> even_k_;
  std::vector<float> even_k_h_;
  std::vector<float> stddev_k_;
  std::vector<float> per_length_;
  std::vector<std::int32_t> first_node_;
  std::vector<const RadianceTable*> table_;
  bool varies_ = false;  ///< any of them
  bool hot_ = false;     ///< something may exceed the tables' range
};

}  // namespace

float SceneHeat::middle_k(std::size_t surface) const {
  const auto holds_middle = [](const HeatSpan& span) { return span.middle_h + span.hours / 2 >= 0; };
  const HeatSpan& span = *std::ranges::find_if(spans, holds_middle);
  const HeatedSurface& heated = span.surfaces.at(surface);
  return heated.middle.temperature_k - static_cast<float>(span.middle_h) * heated.per_h.temperature_k;
}

RowTerm heated_emission(const SceneHeat& heat, const std::vector<std::unique_ptr<RadianceTable>>& tables,
                        const VariationField& field) {
  std::vector<HeatedEmission> emissions;
  std::vector<float> ends_h;
  for (const HeatSpan& span : heat.spans) {
    emissions.emplace_back(span, heat, tables, field);
    ends_h.push_back(static_cast<float>(span.middle_h + span.hours / 2));
  }
  ends_h.pop_back();
  return [emissions = std::move(emissions), ends_h = std::move(ends_h)](Row& row) {
    const auto span = std::ranges::lower_bound(ends_h, row.later_h) - ends_h.begin();
    emissions[static_cast<std::size_t>(span)](row);
  };
}

RowTerm mapped_sky_view() {
  return [](Row& row) {
    kernels::map_sky_view(row.ground_sky_view.data(), row.sky_view.data(), row.sky_view.size());
  };
}

}  // namespace thermal
