#include "bench/evaluator_rows.h"

#include <cmath>
#include <functional>

#include "radiometry/planck.h"
#include "radiometry/radiance_table.h"

namespace thermal {
namespace {

constexpr std::size_t kFramePixels = 640 * 512;
/// Temperatures a row is measured over [K].
struct Range {
  double coldest_k;
  double hottest_k;
};
constexpr Range kNight = {200, 400};
constexpr Range kHot = {421, 1999};  ///< fires, exhausts

using PlaneFunction = std::function<void(std::span<const float>, std::span<float>)>;

/// Temperatures over the whole range in a cache-unfriendly order: multiples of the golden ratio.
std::vector<float> spread_temperatures(const Range& range) {
  constexpr double kGolden = 0.6180339887498949;
  std::vector<float> values;
  for (std::size_t i = 0; i < kFramePixels; ++i) {
    const double turn = kGolden * static_cast<double>(i);
    values.push_back(static_cast<float>(range.coldest_k +
                                        (range.hottest_k - range.coldest_k) * (turn - std::floor(turn))));
  }
  return values;
}

PlaneFunction pixel_by_pixel(const std::function<double(double)>& function) {
  return [function](std::span<const float> in, std::span<float> out) {
    for (std::size_t i = 0; i < in.size(); ++i) {
      out[i] = static_cast<float>(function(static_cast<double>(in[i])));
    }
  };
}

/// One evaluator: its error in double if available, then its time on a plane.
BenchRow forward_row(const std::string& name, const std::function<double(float)>& value,
                     const PlaneFunction& plane, const BandRadiance& reference, std::size_t pixels) {
  BenchRow row{.group = "temperature to radiance", .name = name};
  const std::vector<float> all = spread_temperatures(kNight);
  const std::span<const float> in = std::span(all).first(pixels);
  ErrorStatistics errors;
  for (const float temperature_k : in) {
    const BandValue exact = reference.evaluate(static_cast<double>(temperature_k));
    errors.add(value(temperature_k) / exact.radiance_w_m2_sr - 1,
               exact.radiance_w_m2_sr / exact.derivative_w_m2_sr_k);
  }
  errors.write_to(row);
  std::vector<float> out(pixels);
  const double seconds = shortest_run_s([&] { plane(in, out); });
  row.ns_per_pixel = 1e9 * seconds / static_cast<double>(pixels);
  row.times_memcpy = seconds / memcpy_s(pixels * sizeof(float));
  return row;
}

BenchRow forward_row(const std::string& name, const std::function<double(double)>& function,
                     const BandRadiance& reference, std::size_t pixels) {
  return forward_row(
      name, [function](float t) { return function(static_cast<double>(t)); }, pixel_by_pixel(function),
      reference, pixels);
}

BenchRow inverse_row(const std::string& name, const PlaneFunction& plane, const BandRadiance& reference,
                     std::size_t pixels, bool hot = false) {
  BenchRow row{.group = hot ? "radiance to temperature, 421 to 1999 K" : "radiance to temperature",
               .name = name};
  const std::vector<float> temperatures = spread_temperatures(hot ? kHot : kNight);
  std::vector<float> in(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    in[i] = static_cast<float>(reference.radiance(static_cast<double>(temperatures[i])));
  }
  std::vector<float> out(pixels);
  plane(in, out);
  ErrorStatistics errors;
  for (std::size_t i = 0; i < pixels; ++i) {
    const double exact_k = reference.temperature(static_cast<double>(in[i]));
    errors.add(static_cast<double>(out[i]) / exact_k - 1, exact_k);
  }
  errors.write_to(row);
  const double seconds = shortest_run_s([&] { plane(in, out); });
  row.ns_per_pixel = 1e9 * seconds / static_cast<double>(pixels);
  row.times_memcpy = seconds / memcpy_s(pixels * sizeof(float));
  return row;
}

}  // namespace

std::vector<BenchRow> evaluator_rows() {
  constexpr std::size_t kSlow = 4096;  // pixels for evaluators that take microseconds each
  constexpr std::size_t kMiddling = 65536;
  const BandRadiance reference(SpectralResponse::flat(8, 14));
  const RadianceTable table(reference);
  const TemperatureTable inverse([&reference](double radiance) { return reference.temperature(radiance); },
                                 reference.radiance(kNight.coldest_k - 1),
                                 reference.radiance(kNight.hottest_k + 1), reference.radiance(2000));
  const PlaneFunction exact = pixel_by_pixel([&reference](double l) { return reference.temperature(l); });
  const PlaneFunction tables = [&inverse](std::span<const float> in, std::span<float> out) {
    inverse.temperatures(in, out);
  };
  return {forward_row(
              "reference, panelled Gauss", [&reference](double t) { return reference.radiance(t); },
              reference, kMiddling),
          forward_row("published script, 600 points", script_radiance, reference, kSlow),
          forward_row(
              "table, lines of 1/16 K", [&table](float t) { return static_cast<double>(table.radiance(t)); },
              [&table](std::span<const float> in, std::span<float> out) { table.radiances(in, out); },
              reference, kFramePixels),
          inverse_row("reference, Newton", exact, reference, kSlow),
          inverse_row("table, 8192 lines", tables, reference, kFramePixels),
          inverse_row("reference, Newton", exact, reference, kSlow, true),
          inverse_row("table, 1024 lines an octave", tables, reference, kFramePixels, true)};
}

}  // namespace thermal
