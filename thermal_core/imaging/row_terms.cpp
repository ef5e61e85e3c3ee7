#include "imaging/row_terms.h"

#include <algorithm>
#include <cmath>

namespace thermal {
namespace {

constexpr float kSkyDepth = 1e9F;

/// A function of [0, 1] or of another interval, tabulated for reading with straight lines between nodes.
class Curve {
 public:
  template <typename Function>
  Curve(double end, int steps, const Function& function)
      : steps_per_unit_(static_cast<float>(steps / end)), last_(static_cast<float>(steps)) {
    for (int node = 0; node <= steps + 1; ++node) {
      values_.push_back(static_cast<float>(function(std::min(end, end * node / steps))));
    }
  }

  /// At x, held constant past both ends; x must not be NaN.
  [[nodiscard]] float at(float x) const noexcept {
    const float position = std::clamp(x * steps_per_unit_, 0.0F, last_);
    const auto node = static_cast<int>(position);
    const float* const value = values_.data() + node;
    return value[0] + (position - static_cast<float>(node)) * (value[1] - value[0]);
  }

 private:
  float steps_per_unit_;
  float last_;
  std::vector<float> values_;
};

/// x and y in the world of what a pixel shows: origin + depth * direction.
struct GroundPoint {
  float x;
  float y;
};

GroundPoint ground_point(const CameraPose& pose, float ray_x, float ray_y, float depth_m) noexcept {
  const auto& r = pose.rotation;
  return {pose.position_m[0] + depth_m * (r[0][0] * ray_x + r[0][1] * ray_y + r[0][2]),
          pose.position_m[1] + depth_m * (r[1][0] * ray_x + r[1][1] * ray_y + r[1][2])};
}

/// Radiance of a clear sky's direction against a blackbody's at air temperature: the zenith's emissivity, seen
/// through a path longer by the secant.
Curve mirrored_sky(const Air& air) {
  constexpr int kSteps = 256;
  const double through = 1 - zenith_emissivity(air);
  return Curve(1, kSteps, [through](double cosine) {
    constexpr double kLowest = 0.05;  // 3 deg above the horizon: no plane's secant means anything below
    return 1 - std::pow(through, 1 / std::max(cosine, kLowest));
  });
}

}  // namespace

RowTerm emission(const SurfaceOpticsList& surfaces) {
  return [&surfaces](Row& row) {
    for (std::size_t i = 0; i < row.surface.size(); ++i) {
      row.radiance_w_m2_sr[i] = surfaces[row.surface[i]].emitted_w_m2_sr;
    }
  };
}

RowTerm varied_emission(const SurfaceOpticsList& surfaces, const VariationField& field, const CameraRays& rays) {
  return [&surfaces, &field, &rays](Row& row) {
    const float ray_y = rays.y()[static_cast<std::size_t>(row.y)];
    for (std::size_t i = 0; i < row.surface.size(); ++i) {
      const SurfaceOptics& surface = surfaces[row.surface[i]];
      const float depth_m = row.depth_m[i];
      const bool varies = surface.variation_stddev_k > 0 && depth_m > 0 && depth_m < kSkyDepth;
      if (!varies) {
        row.radiance_w_m2_sr[i] = surface.emitted_w_m2_sr;
        continue;
      }
      const GroundPoint point = ground_point(*row.pose, rays.x()[i], ray_y, depth_m);
      const float scale = surface.per_correlation_length;
      const float value = field.sample(point.x * scale, point.y * scale, depth_m * rays.pixel_width() * scale);
      row.radiance_w_m2_sr[i] =
          surface.table->radiance(surface.temperature_k + surface.variation_stddev_k * value);
    }
  };
}

RowTerm orientation(const CameraRays& rays) {
  return [&rays](Row& row) {
    const std::size_t width = row.surface.size();
    row.sky_view.resize(width);
    row.cosine.resize(width);
    const auto& r = row.pose->rotation;
    const float ray_y = rays.y()[static_cast<std::size_t>(row.y)];
    const auto length = rays.length().row(row.y);
    for (std::size_t i = 0; i < width; ++i) {
      const float nx = row.normal[0][i];
      const float ny = row.normal[1][i];
      const float nz = row.normal[2][i];
      const float ray_x = rays.x()[i];
      const float along = nx * (r[0][0] * ray_x + r[0][1] * ray_y + r[0][2]) +
                          ny * (r[1][0] * ray_x + r[1][1] * ray_y + r[1][2]) +
                          nz * (r[2][0] * ray_x + r[2][1] * ray_y + r[2][2]);
      const float norm2 = nx * nx + ny * ny + nz * nz;
      const bool usable = norm2 > 0.81F && norm2 < 1.21F;  // false for NaN
      const float up = along > 0 ? -nz : nz;
      row.cosine[i] = usable ? std::min(std::abs(along) / length[i], 1.0F) : 1.0F;
      row.sky_view[i] = usable ? std::clamp(0.5F + 0.5F * up, 0.0F, 1.0F) : 1.0F;
    }
  };
}

RowTerm reflectivity(const SurfaceOpticsList& surfaces) {
  return [&surfaces](Row& row) {
    row.reflected_w_m2_sr.resize(row.surface.size());
    for (std::size_t i = 0; i < row.surface.size(); ++i) {
      row.reflected_w_m2_sr[i] = surfaces[row.surface[i]].reflected_air_w_m2_sr;
    }
  };
}

RowTerm angular_emissivity(const SurfaceOpticsList& surfaces) {
  constexpr int kSteps = 1024;
  const auto law = [](AngularLaw which) {
    return Curve(1, kSteps, [which](double cosine) { return angular_factor(which, cosine); });
  };
  return [&surfaces, water = law(AngularLaw::water), soil = law(AngularLaw::soil)](Row& row) {
    const bool reflects = !row.reflected_w_m2_sr.empty();
    for (std::size_t i = 0; i < row.surface.size(); ++i) {
      const SurfaceOptics& surface = surfaces[row.surface[i]];
      if (surface.angular == AngularLaw::none) continue;
      const float factor = (surface.angular == AngularLaw::water ? water : soil).at(row.cosine[i]);
      row.radiance_w_m2_sr[i] *= factor;
      if (reflects) row.reflected_w_m2_sr[i] += (1 - factor) * surface.emitted_as_air_w_m2_sr;
    }
  };
}

RowTerm sky_reflection(const SurfaceOpticsList& surfaces, const Air& air) {
  const auto sky_deficit = static_cast<float>(1 - sky_emissivity(air));
  return [&surfaces, sky_deficit, mirrored = mirrored_sky(air)](Row& row) {
    for (std::size_t i = 0; i < row.surface.size(); ++i) {
      const bool mirror = surfaces[row.surface[i]].angular == AngularLaw::water;
      const float surroundings = mirror ? mirrored.at(row.cosine[i]) : 1 - row.sky_view[i] * sky_deficit;
      row.radiance_w_m2_sr[i] += row.reflected_w_m2_sr[i] * surroundings;
    }
  };
}

RowTerm path(const SurfaceOpticsList& surfaces, const Air& air, float air_radiance_w_m2_sr,
             const CameraRays& rays) {
  constexpr double kLongest = 1000;
  constexpr int kSteps = 2048;
  // Against the root of the range, in which the fit is smooth from end to end.
  const Curve absorbed(std::sqrt(kLongest), kSteps,
                       [&air](double root) { return 1 - path_transmittance(air, root * root); });
  return [&surfaces, &rays, absorbed, air_radiance_w_m2_sr](Row& row) {
    constexpr auto kFarthest = static_cast<float>(kLongest);
    const auto length = rays.length().row(row.y);
    for (std::size_t i = 0; i < row.surface.size(); ++i) {
      const float range_m = row.depth_m[i] * length[i];
      const float clamped_m = range_m < kFarthest ? std::max(range_m, 0.0F) : kFarthest;  // NaN: the farthest
      const float share = surfaces[row.surface[i]].sky ? 0.0F : absorbed.at(std::sqrt(clamped_m));
      row.radiance_w_m2_sr[i] += share * (air_radiance_w_m2_sr - row.radiance_w_m2_sr[i]);
    }
  };
}

}  // namespace thermal
