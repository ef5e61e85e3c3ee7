#include "bench/radiance_suite.h"

#include <cmath>

#include "base/parallel.h"
#include "bench/bench_scene.h"
#include "bench/evaluator_rows.h"
#include "imaging/frame_converter.h"
#include "radiometry/band_radiance.h"
#include "radiometry/spectral_air.h"

namespace thermal {
namespace {

SpectralResponse flat_8_14_um() { return SpectralResponse::flat(8, 14); }

/// The terms' formulas in double precision and without tables, for a single pixel.
class ExactChain {
 public:
  ExactChain(const BenchScene& scene, const MaterialLibrary& materials, const PhysicsSettings& settings)
      : scene_(scene),
        settings_(settings),
        map_(scene.manifest, materials),
        field_(settings.seed),
        rays_(scene.manifest.camera),
        pose_(pose_of(*scene.manifest.frames[0].camera_to_world)),
        air_(settings.weather.air, settings.response),
        blackbody_(settings.response),
        air_radiance_(blackbody_.radiance(settings.weather.air.temperature_k)) {}

  /// Radiance at the sensor of one pixel.
  [[nodiscard]] double radiance(int x, int y) const {
    const Material& material = material_at(x, y);
    const Air& air = settings_.weather.air;
    const BandRadiance band(settings_.response, EmissivitySpectrum(material.emissivity));
    const Terms& terms = settings_.terms;
    const double depth_m = static_cast<double>(scene_.passes.depth_m.at(x, y));
    const double cosine = cosine_at(x, y);
    const double factor = terms.angular ? angular_factor(material.angular, cosine) : 1;
    double value = factor * band.radiance(temperature_at(x, y, material, depth_m));
    const double reflected = air_radiance_ - factor * band.radiance(air.temperature_k);
    if (terms.sky) value += reflected * surroundings_at(x, y, material, cosine);
    if (!terms.path) return value;
    const double range_m = depth_m * static_cast<double>(rays_.length().at(x, y));
    const double through = air_.path_transmittance(range_m);
    return through * value + (1 - through) * air_radiance_;
  }

  [[nodiscard]] const BandRadiance& blackbody() const noexcept { return blackbody_; }

 private:
  [[nodiscard]] const Material& material_at(int x, int y) const {
    std::uint16_t number = 0;
    const std::uint16_t object = scene_.passes.object_index.at(x, y);
    map_.number({&object, 1}, {}, {&number, 1});
    return *map_.surfaces()[number].material;
  }

  [[nodiscard]] std::array<double, 3> ray_at(int x, int y) const {
    std::array<double, 3> ray{};
    const std::array<double, 3> local = {static_cast<double>(rays_.x().at(x, y)),
                                         static_cast<double>(rays_.y().at(x, y)), 1};
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column) {
        ray[row] += static_cast<double>(pose_.rotation[row][column]) * local[column];
      }
    }
    return ray;
  }

  [[nodiscard]] double cosine_at(int x, int y) const {
    const std::array<double, 3> ray = ray_at(x, y);
    double along = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      along += ray[axis] * static_cast<double>(scene_.passes.normal[axis].at(x, y));
    }
    return std::min(1.0, -along / static_cast<double>(rays_.length().at(x, y)));
  }

  [[nodiscard]] double temperature_at(int x, int y, const Material& material, double depth_m) const {
    const double mean_k = material.temperature_k(settings_.weather.air.temperature_k);
    if (!settings_.terms.variation || material.variation.stddev_k == 0) return mean_k;
    const std::array<double, 3> ray = ray_at(x, y);
    const double scale = 1 / material.variation.correlation_length_m;
    const double x_m = static_cast<double>(pose_.position_m[0]) + depth_m * ray[0];
    const double y_m = static_cast<double>(pose_.position_m[1]) + depth_m * ray[1];
    const double footprint = depth_m * static_cast<double>(rays_.pixel_width()) * scale;
    const float value = field_.sample(static_cast<float>(x_m * scale), static_cast<float>(y_m * scale),
                                      static_cast<float>(footprint));
    return mean_k + material.variation.stddev_k * static_cast<double>(value);
  }

  [[nodiscard]] double surroundings_at(int x, int y, const Material& material, double cosine) const {
    if (material.mirrors()) {
      const double mirrored = settings_.terms.angular || settings_.terms.sky ? cosine : 1;
      return air_.sky_emissivity(mirrored);
    }
    const double sky_view = 0.5 + 0.5 * static_cast<double>(scene_.passes.normal[2].at(x, y));
    return 1 - sky_view * (1 - air_.sky_emissivity());
  }

  const BenchScene& scene_;
  const PhysicsSettings& settings_;
  SurfaceMap map_;
  VariationField field_;
  CameraRays rays_;
  CameraPose pose_;
  BandAir air_;
  BandRadiance blackbody_;
  double air_radiance_;
};

/// Bytes of the planes that a chain reads, and of the one it writes.
std::size_t bytes_moved(const PassNeeds& needs, std::size_t pixels) {
  std::size_t bytes = 2 * sizeof(std::uint16_t) + sizeof(float);
  if (needs.depth) bytes += sizeof(float);
  if (needs.normals) bytes += 3 * sizeof(float);
  return bytes * pixels;
}

BenchRow term_row(const std::string& name, const Terms& terms, const BenchScene& scene,
                  const MaterialLibrary& materials) {
  const PhysicsSettings settings = {
      .terms = terms, .weather = weather_of(Season::winter), .response = flat_8_14_um(), .seed = 1};
  const SceneRadiance chain(scene.manifest, materials, settings);
  const ExactChain exact(scene, materials, settings);
  BenchRow row{.group = "term: " + name, .name = name};
  Plane<float> plane = chain.radiance(scene.passes, scene.manifest.frames[0]);
  ErrorStatistics errors;
  constexpr int kEvery = 7;  // pixels apart: the double-precision reference takes microseconds each
  for (int y = 0; y < plane.height_px(); y += kEvery) {
    for (int x = 0; x < plane.width_px(); x += kEvery) {
      const double value = exact.radiance(x, y);
      const BandValue band = exact.blackbody().evaluate(exact.blackbody().temperature(value));
      errors.add(static_cast<double>(plane.at(x, y)) / value - 1, value / band.derivative_w_m2_sr_k);
    }
  }
  errors.write_to(row);
  const double seconds =
      shortest_run_s([&] { chain.radiance(scene.passes, scene.manifest.frames[0], plane); });
  row.ns_per_pixel = 1e9 * seconds / static_cast<double>(plane.size());
  row.times_memcpy = seconds / memcpy_s(bytes_moved(chain.needs(), plane.size()));
  return row;
}

/// Radiance of the small picture with a person at one of many subpixel positions.
Plane<float> person_radiance(int factor, int position, const FrameConverter& converter) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr double kPlastic = 0.7548776662466927;
  const double x_px = 16 + std::fmod(kGolden * position, 1.0);
  const double y_px = 16 + std::fmod(kPlastic * position, 1.0);
  return converter.convert(person_from_above(factor, x_px, y_px).passes).radiance_w_m2_sr;
}

BenchRow supersample_row(int factor, const MaterialLibrary& materials) {
  constexpr int kPlaces = 64;
  constexpr int kFinest = 8;
  const FrameConverter coarse(person_from_above(factor, 16, 16).manifest, materials, Season::winter, {});
  const FrameConverter fine(person_from_above(kFinest, 16, 16).manifest, materials, Season::winter, {});
  const BandRadiance blackbody(flat_8_14_um());
  BenchRow row{.group = "supersampling of a person at 122 m", .name = std::to_string(factor) + " x"};
  ErrorStatistics errors;
  for (int position = 0; position < kPlaces; ++position) {
    const Plane<float> picture = person_radiance(factor, position, coarse);
    const Plane<float> exact = person_radiance(kFinest, position, fine);
    const float background = exact.at(0, 0);
    for (std::size_t i = 0; i < picture.size(); ++i) {
      if (exact.pixels()[i] == background) continue;
      const auto value = static_cast<double>(exact.pixels()[i]);
      const BandValue band = blackbody.evaluate(blackbody.temperature(value));
      errors.add(static_cast<double>(picture.pixels()[i]) / value - 1, value / band.derivative_w_m2_sr_k);
    }
  }
  errors.write_to(row);
  const BenchScene scene = person_from_above(factor, 16, 16);
  const double seconds = shortest_run_s([&] { (void)coarse.convert(scene.passes); });
  const auto pixels = static_cast<double>(scene.passes.object_index.size()) / (factor * factor);
  row.ns_per_pixel = 1e9 * seconds / pixels;
  return row;
}

/// The terms of a physical scene, one by one and together, on a 640 x 512 frame; error against the same
/// formulas in double precision, pixel by pixel.
std::vector<BenchRow> term_rows(const MaterialLibrary& materials) {
  const BenchScene scene = rolling_ground();
  std::vector<BenchRow> rows = {term_row("emission alone", {}, scene, materials)};
  for (const TermInfo& term : kTerms) {
    // These terms change values, not the work per pixel; or they need the heat balance, see --suite heat; or belong to
    // the sensor.
    if (term.name == "smear" || term.name == "parts" || term.name == "falloff" || term.name == "place" ||
        term.name == "facing")
      continue;
    Terms one;
    one.*term.kept = true;
    rows.push_back(term_row("emission + " + std::string(term.name), one, scene, materials));
  }
  const Terms all = {.variation = true,
                     .parts = true,
                     .sky = true,
                     .angular = true,
                     .mirror = true,
                     .path = true,
                     .falloff = true};
  rows.push_back(term_row("all terms", all, scene, materials));
  return rows;
}

/// A person seen from straight above at 122 m, a few pixels in size, supersampled 1 to 4 times per axis; error of the
/// affected pixels against 8 times.
std::vector<BenchRow> supersample_rows(const MaterialLibrary& materials) {
  std::vector<BenchRow> rows;
  for (const int factor : {1, 2, 3, 4}) rows.push_back(supersample_row(factor, materials));
  return rows;
}

}  // namespace

std::vector<BenchRow> run_radiance_suite(const MaterialLibrary& materials) {
  return with_threads(1, [&] {
    std::vector<BenchRow> rows = evaluator_rows();
    for (const auto& part : {term_rows(materials), supersample_rows(materials)}) {
      rows.insert(rows.end(), part.begin(), part.end());
    }
    mark_dominated(rows);
    return rows;
  });
}

}  // namespace thermal
