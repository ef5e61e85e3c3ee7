#include "imaging/row_terms.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "base/interpolation.h"
#include "imaging/row_kernels.h"

namespace thermal {
namespace {

/// One property of every surface, as a lookup table by surface number.
template <typename T = float, typename Get>
std::vector<T> column(const SurfaceOpticsList& surfaces, const Get& get) {
  std::vector<T> values;
  for (const SurfaceOptics& surface : surfaces) values.push_back(static_cast<T>(get(surface)));
  return values;
}

kernels::CameraAxis axis_of(const Row& row, std::size_t axis) {
  const auto& r = row.pose->rotation.at(axis);
  return {.right = r[0], .down = r[1], .forward = r[2]};
}

/// A function of the cosine of viewing angle for water or sky, tabulated, because it is slow.
class AngleCurve {
 public:
  template <typename Function>
  explicit AngleCurve(const Function& function) {
    for (int node = 0; node <= kSteps + 1; ++node) {
      values_.push_back(static_cast<float>(function(std::min(1.0, static_cast<double>(node) / kSteps))));
    }
  }
  [[nodiscard]] float at(float cosine) const noexcept {
    const float position = cosine * kSteps;
    const auto node = static_cast<std::size_t>(position);
    return values_[node] + (position - static_cast<float>(node)) * (values_[node + 1] - values_[node]);
  }

 private:
  static constexpr int kSteps = 4096;
  std::vector<float> values_;
};

bool is_water(const SurfaceOptics& surface) { return surface.angular == AngularLaw::water; }

/// Polynomials for the absorption of the path. See BandAir::path_transmittance(): Beer's law up to 30 m, then the fit
/// in sqrt(range). Error against it in double precision below 1e-7, or 0.01 mK for 20 K between surface and air.
kernels::Absorption fit_absorption(const BandAir& air) {
  constexpr double kNearEnd = 30;
  constexpr double kFarthest = 1000;
  const double first = std::sqrt(kNearEnd);
  const double last = std::sqrt(kFarthest);
  const auto absorbed = [&air](double range_m) { return 1 - air.path_transmittance(range_m); };
  kernels::Absorption fit;
  fit.near_end_m = static_cast<float>(kNearEnd);
  fit.farthest_m = static_cast<float>(kFarthest);
  fit.far_middle = static_cast<float>((first + last) / 2);
  fit.far_half = static_cast<float>((last - first) / 2);
  // A power series about 0 for the near part: at range 0 the absorption must be exactly 0.
  const double exponent = std::log(air.path_transmittance(kNearEnd));
  double term = 1;
  for (std::size_t k = 1; k < kernels::Absorption::kTerms; ++k) {
    term *= exponent / static_cast<double>(k);
    fit.near.at(k) = static_cast<float>(-term);
  }
  const auto far = fit_polynomial(
      [&](double x) {
        const double root = (first + last) / 2 + x * (last - first) / 2;
        return absorbed(std::clamp(root * root, kNearEnd, kFarthest));
      },
      kernels::Absorption::kTerms);
  std::transform(far.begin(), far.end(), fit.far.begin(), [](double c) { return static_cast<float>(c); });
  return fit;
}

/// The same for the mean of the absorption over the path.
kernels::Absorption fit_mean_absorption(const BandAir& air) {
  kernels::Absorption fit = fit_absorption(air);
  for (std::size_t k = 1; k < fit.near.size(); ++k) fit.near.at(k) /= static_cast<float>(k + 1);
  const auto middle = static_cast<double>(fit.far_middle);
  const auto half = static_cast<double>(fit.far_half);
  const auto far = fit_polynomial(
      [&](double x) {
        const double root = middle + x * half;
        return air.mean_path_absorption(root * root);
      },
      kernels::Absorption::kTerms);
  std::transform(far.begin(), far.end(), fit.far.begin(), [](double c) { return static_cast<float>(c); });
  return fit;
}

}  // namespace

RowTerm emission(const SurfaceOpticsList& surfaces) {
  return [emitted = column(surfaces, [](const auto& s) { return s.emitted_w_m2_sr; })](Row& row) {
    kernels::look_up(row.surface.data(), emitted.data(), row.radiance_w_m2_sr.data(), row.surface.size());
  };
}

RowTerm sky_emission(const BandAir& air, float air_radiance_w_m2_sr) {
  const AngleCurve slant([&air](double cosine) { return air.sky_emissivity(cosine); });
  return [slant, air_radiance_w_m2_sr](Row& row) {
    const kernels::CameraAxis up = axis_of(row, 2);
    for (std::size_t i = 0; i < row.surface.size(); ++i) {
      if (row.surface[i] != 0) continue;
      const float rise = up.right * row.ray_x[i] + up.down * row.ray_y[i] + up.forward;
      const float cosine = rise > 0 ? rise / row.ray_length[i] : 0.0F;  // 0 for NaN
      row.radiance_w_m2_sr[i] = air_radiance_w_m2_sr * slant.at(std::min(cosine, 1.0F));
    }
  };
}

RowTerm varied_emission(const SurfaceOpticsList& surfaces, const VariationField& field) {
  std::vector<float> nodes;
  std::vector<std::int32_t> first_node;
  std::vector<float> position;
  std::vector<float> spread;
  for (const SurfaceOptics& surface : surfaces) {
    first_node.push_back(static_cast<std::int32_t>(nodes.size()));
    if (surface.table != nullptr) {
      surface.table->append_nodes(nodes);
      position.push_back((surface.temperature_k - RadianceTable::kColdest) * RadianceTable::kNodesPerKelvin);
      spread.push_back(surface.variation_stddev_k * RadianceTable::kNodesPerKelvin);
    } else {
      nodes.insert(nodes.end(), {surface.emitted_w_m2_sr, 0.0F});
      position.push_back(0);
      spread.push_back(0);
    }
  }
  return [&field, nodes, first_node, position, spread,
          scale = column(surfaces, [](const auto& s) { return s.per_correlation_length; })](Row& row) {
    const std::size_t width = row.surface.size();
    for (auto* scratch : {&row.point_x, &row.point_y, &row.footprint, &row.variation}) scratch->resize(width);
    kernels::find_points({.surface = row.surface.data(),
                          .per_correlation_length = scale.data(),
                          .depth_m = row.depth_m.data(),
                          .ray_x = row.ray_x.data(),
                          .ray_y = row.ray_y.data(),
                          .origin_x_m = row.pose->position_m[0],
                          .origin_y_m = row.pose->position_m[1],
                          .x = axis_of(row, 0),
                          .y = axis_of(row, 1),
                          .pixel_width = row.sample_width},
                         row.point_x.data(), row.point_y.data(), row.footprint.data(), width);
    field.sample(row.point_x, row.point_y, row.footprint, row.variation);
    kernels::emit_varied({.surface = row.surface.data(),
                          .position = position.data(),
                          .spread = spread.data(),
                          .table = first_node.data(),
                          .node_w_m2_sr = nodes.data(),
                          .variation = row.variation.data(),
                          .last_node = RadianceTable::kSteps - 1},
                         row.radiance_w_m2_sr.data(), width);
  };
}

RowTerm orientation() {
  return [](Row& row) {
    const std::size_t width = row.surface.size();
    row.sky_view.resize(width);
    row.cosine.resize(width);
    kernels::orient({.nx = row.normal[0].data(),
                     .ny = row.normal[1].data(),
                     .nz = row.normal[2].data(),
                     .ray_x = row.ray_x.data(),
                     .ray_y = row.ray_y.data(),
                     .ray_length = row.ray_length.data(),
                     .x = axis_of(row, 0),
                     .y = axis_of(row, 1),
                     .z = axis_of(row, 2)},
                    row.sky_view.data(), row.cosine.data(), width);
  };
}

RowTerm water_pixels(const SurfaceOpticsList& surfaces) {
  return [wet = column<char>(surfaces, is_water)](Row& row) {
    row.water.clear();
    for (std::size_t i = 0; i < row.surface.size(); ++i) {
      if (wet[row.surface[i]] != 0) row.water.push_back(i);
    }
  };
}

RowTerm reflectivity(const SurfaceOpticsList& surfaces) {
  return [reflected = column(surfaces, [](const auto& s) { return s.reflected_air_w_m2_sr; })](Row& row) {
    row.reflected_w_m2_sr.resize(row.surface.size());
    kernels::look_up(row.surface.data(), reflected.data(), row.reflected_w_m2_sr.data(), row.surface.size());
  };
}

RowTerm angular_emissivity(const SurfaceOpticsList& surfaces) {
  const auto loss = [](const SurfaceOptics& s) {
    return s.angular == AngularLaw::soil ? 1 - angular_factor(AngularLaw::soil, 0) : 0.0;
  };
  const AngleCurve water([](double cosine) { return angular_factor(AngularLaw::water, cosine); });
  return [water, loss = column(surfaces, loss),
          as_air = column(surfaces, [](const auto& s) { return s.emitted_as_air_w_m2_sr; })](Row& row) {
    row.reflected_w_m2_sr.resize(row.surface.size());  // filled by reflectivity, otherwise never read
    kernels::fall_off({.surface = row.surface.data(),
                       .loss = loss.data(),
                       .emitted_as_air_w_m2_sr = as_air.data(),
                       .cosine = row.cosine.data()},
                      row.radiance_w_m2_sr.data(), row.reflected_w_m2_sr.data(), row.surface.size());
    for (const std::size_t i : row.water) {
      const float factor = water.at(row.cosine[i]);
      row.radiance_w_m2_sr[i] *= factor;
      row.reflected_w_m2_sr[i] += (1 - factor) * as_air[row.surface[i]];
    }
  };
}

namespace {

/// The surfaces that a row's water mirrors, as a separate row.
struct MirroredRow {
  /// For the water pixels `from`.
  MirroredRow(const Row& row, std::vector<std::size_t> from_pixels)
      : from(std::move(from_pixels)),
        pose(*row.pose),
        surface(at(row.mirrored_surface)),
        ray_x(at(row.ray_x)),
        ray_y(at(row.ray_y)),
        ray_length(at(row.ray_length)),
        depth_m(at(row.mirrored_depth_m)),
        normal{at(row.mirrored_normal[0]), at(row.mirrored_normal[1]), at(row.mirrored_normal[2])},
        leg_m(from.size()),
        origin_z_m(from.size()),
        radiance_w_m2_sr(from.size()) {
    const kernels::CameraAxis up = axis_of(row, 2);
    for (std::size_t k = 0; k < from.size(); ++k) {
      const float to_water_m = row.depth_m[from[k]];
      const float rise = up.right * ray_x[k] + up.down * ray_y[k] + up.forward;
      origin_z_m[k] = row.pose->position_m[2] + 2 * to_water_m * rise;
      leg_m[k] = depth_m[k] - to_water_m;
    }
    for (float& entry : pose.rotation[2]) entry = -entry;
    seen.surface = surface;
    seen.ray_x = ray_x;
    seen.ray_y = ray_y;
    seen.ray_length = ray_length;
    seen.sample_width = row.sample_width;
    seen.depth_m = depth_m;
    seen.normal = {normal[0], normal[1], normal[2]};
    seen.pose = &pose;
    seen.origin_z_m = origin_z_m;
    seen.later_h = row.later_h;
    seen.radiance_w_m2_sr = radiance_w_m2_sr;
  }
  MirroredRow(const MirroredRow&) = delete;
  MirroredRow& operator=(const MirroredRow&) = delete;

  template <typename T>
  [[nodiscard]] std::vector<std::remove_const_t<T>> at(std::span<T> values) const {
    std::vector<std::remove_const_t<T>> chosen;
    chosen.reserve(from.size());
    for (const std::size_t i : from) chosen.push_back(values[i]);
    return chosen;
  }

  std::vector<std::size_t> from;
  CameraPose pose;  ///< of the camera below the water
  std::vector<std::uint16_t> surface;
  std::vector<float> ray_x;
  std::vector<float> ray_y;
  std::vector<float> ray_length;
  std::vector<float> depth_m;
  std::array<std::vector<float>, 3> normal;
  std::vector<float> leg_m;  ///< part of the depth from the water on
  std::vector<float> origin_z_m;
  std::vector<float> radiance_w_m2_sr;
  Row seen;
};

}  // namespace

RowTerm mirrored_surfaces(std::vector<RowTerm> terms, RowTerm path, float air_radiance_w_m2_sr) {
  return [terms = std::move(terms), path = std::move(path), per_air = 1 / air_radiance_w_m2_sr](Row& row) {
    if (row.mirrored_surface.empty()) return;
    std::vector<std::size_t> pixels;
    for (const std::size_t i : row.water) {
      if (row.mirrored_surface[i] != 0) pixels.push_back(i);
    }
    if (pixels.empty()) return;
    MirroredRow mirrored(row, std::move(pixels));
    for (const RowTerm& term : terms) term(mirrored.seen);
    mirrored.seen.depth_m = mirrored.leg_m;
    if (path) path(mirrored.seen);
    for (std::size_t k = 0; k < mirrored.from.size(); ++k) {
      const std::size_t i = mirrored.from[k];
      row.radiance_w_m2_sr[i] += row.reflected_w_m2_sr[i] * per_air * mirrored.radiance_w_m2_sr[k];
      row.reflected_w_m2_sr[i] = 0;
    }
  };
}

RowTerm sky_reflection(const BandAir& air) {
  const auto sky_deficit = static_cast<float>(1 - air.sky_emissivity());
  const AngleCurve mirrored([&air](double cosine) { return air.sky_emissivity(cosine); });
  return [sky_deficit, mirrored](Row& row) {
    // Water first: nothing is left there for the diffuse kernel that follows.
    for (const std::size_t i : row.water) {
      row.radiance_w_m2_sr[i] += row.reflected_w_m2_sr[i] * mirrored.at(row.cosine[i]);
      row.reflected_w_m2_sr[i] = 0;
    }
    kernels::reflect({.reflected_w_m2_sr = row.reflected_w_m2_sr.data(),
                      .sky_view = row.sky_view.data(),
                      .sky_deficit = sky_deficit},
                     row.radiance_w_m2_sr.data(), row.surface.size());
  };
}

RowTerm path(const BandAir& air, float air_radiance_w_m2_sr) {
  return [absorption = fit_absorption(air), air_radiance_w_m2_sr](Row& row) {
    kernels::pass_air({.surface = row.surface.data(),
                       .depth_m = row.depth_m.data(),
                       .ray_length = row.ray_length.data(),
                       .air_w_m2_sr = air_radiance_w_m2_sr},
                      absorption, row.radiance_w_m2_sr.data(), row.surface.size());
  };
}

RowTerm path_inversion(const BandAir& air, float more_w_m2_sr) {
  return [share = fit_mean_absorption(air), more_w_m2_sr](Row& row) {
    kernels::warm_air({.surface = row.surface.data(),
                       .depth_m = row.depth_m.data(),
                       .ray_length = row.ray_length.data(),
                       .more_w_m2_sr = more_w_m2_sr},
                      share, row.radiance_w_m2_sr.data(), row.surface.size());
  };
}

}  // namespace thermal
