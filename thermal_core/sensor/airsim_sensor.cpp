#include "sensor/airsim_sensor.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "radiometry/band_radiance.h"
#include "radiometry/script_radiance.h"
#include "sensor/blur.h"

namespace thermal {
namespace {

constexpr double kLargestCount = 255;
constexpr std::size_t kPixelsAChunk = 16384;

/// Apparent temperature by exact Planck, tabulated for anything a savanna night holds.
TemperatureTable apparent_temperature_table(const SpectralResponse& response) {
  constexpr double kColdest = 180;
  constexpr double kHottest = 420;
  const BandRadiance band(response);
  const double low = band.radiance(kColdest);
  const double high = band.radiance(kHottest);
  return TemperatureTable([band](double radiance) { return band.temperature(radiance); }, low, high);
}

/// Sum, and sum of squares about a middle value, of a chunk of pixels.
struct Moments {
  double sum = 0;
  double squares = 0;
};

/// Standard deviation of all pixels; the order of summation depends on the size of the picture alone.
double standard_deviation(const Plane<float>& picture) {
  const auto pixels = picture.pixels();
  const double middle = static_cast<double>(pixels.front());  // any value of the picture's order of magnitude
  std::vector<Moments> chunks((pixels.size() + kPixelsAChunk - 1) / kPixelsAChunk);
  parallel_for(pixels.size(), kPixelsAChunk, [&](std::size_t begin, std::size_t end) {
    Moments& moments = chunks[begin / kPixelsAChunk];
    for (const float pixel : pixels.subspan(begin, end - begin)) {
      const double difference = static_cast<double>(pixel) - middle;
      moments.sum += difference;
      moments.squares += difference * difference;
    }
  });
  Moments total;
  for (const Moments& chunk : chunks) {
    total.sum += chunk.sum;
    total.squares += chunk.squares;
  }
  const auto count = static_cast<double>(pixels.size());
  const double mean = total.sum / count;
  return std::sqrt(std::max(0.0, total.squares / count - mean * mean));
}

template <typename Count>
Count to_count(float value, float largest) noexcept {
  return value > 0 ? static_cast<Count>(std::min(value, largest)) : Count{0};  // NaN compares false: 0
}

}  // namespace

std::function<double(double temperature_k)> radiance_of(const SensorParameters& parameters) {
  if (parameters.radiance == RadianceModel::script) return script_radiance;
  return [band = BandRadiance(parameters.response)](double temperature_k) {
    return band.radiance(temperature_k);
  };
}

AirsimSensor::AirsimSensor(const SensorParameters& parameters, Clip clip, float brightest_w_m2_sr)
    : parameters_(parameters),
      clip_(std::move(clip)),
      w_m2_sr_per_dn_(static_cast<double>(brightest_w_m2_sr) / kLargestCount),
      temperature_table_(apparent_temperature_table(parameters.response)),
      flicker_(clip_.seed, clip_.id, clip_.frame_rate_hz, clip_.width_px, clip_.height_px),
      fixed_pattern_(fixed_pattern(clip_.seed, clip_.id, clip_.width_px, clip_.height_px)) {
  assert(brightest_w_m2_sr > 0);
}

SensorFrame AirsimSensor::expose(const Plane<float>& radiance_w_m2_sr) {
  Plane<float> signal_dn = gaussian_blur(radiance_w_m2_sr, parameters_.blur_sigma_px);
  // Double, so that a count computed from a whole-count radiance does not land just below that count.
  for (float& pixel : signal_dn.pixels()) {
    pixel = static_cast<float>(static_cast<double>(pixel) / w_m2_sr_per_dn_);
  }
  add_noise(signal_dn);
  ++frame_;
  return {.ir8 = to_ir8(signal_dn), .ir16 = to_ir16(signal_dn)};
}

void AirsimSensor::add_noise(Plane<float>& signal_dn) {
  if (!fixed_pattern_dn_) {
    fixed_pattern_dn_ = static_cast<float>(parameters_.fixed_pattern_ratio * standard_deviation(signal_dn));
  }
  Plane<float> noise_dn(signal_dn.width_px(), signal_dn.height_px());
  const auto white = static_cast<float>(parameters_.white_noise_stddev_dn);
  const auto flicker = static_cast<float>(parameters_.flicker_noise_stddev_dn);
  if (white > 0) add_white_noise(clip_.seed, clip_.id, frame_, white, noise_dn);
  if (flicker > 0) flicker_.add_next(flicker, noise_dn);
  const auto noise = noise_dn.pixels();
  const auto pattern = fixed_pattern_.pixels();
  for (std::size_t i = 0; i < noise.size(); ++i) noise[i] += *fixed_pattern_dn_ * pattern[i];
  const auto gain = clip_.noise_gain.pixels();
  for (std::size_t i = 0; i < gain.size(); ++i) noise[i] *= gain[i];
  const auto signal = signal_dn.pixels();
  for (std::size_t i = 0; i < signal.size(); ++i) signal[i] += noise[i];
}

Plane<std::uint8_t> AirsimSensor::to_ir8(const Plane<float>& signal_dn) const {
  Plane<std::uint8_t> counts(signal_dn.width_px(), signal_dn.height_px());
  const float rounding = parameters_.normalisation == Normalisation::table_max ? 0.0F : 0.5F;
  const auto in = signal_dn.pixels();
  const auto out = counts.pixels();
  for (std::size_t i = 0; i < in.size(); ++i) {
    out[i] = to_count<std::uint8_t>(in[i] + rounding, static_cast<float>(kLargestCount));
  }
  return counts;
}

Plane<std::uint16_t> AirsimSensor::to_ir16(const Plane<float>& signal_dn) const {
  Plane<std::uint16_t> counts(signal_dn.width_px(), signal_dn.height_px());
  const auto w_m2_sr_per_dn = static_cast<float>(w_m2_sr_per_dn_);
  const auto counts_per_kelvin = static_cast<float>(1 / parameters_.kelvin_per_count);
  const auto in = signal_dn.pixels();
  const auto out = counts.pixels();
  parallel_for(in.size(), kPixelsAChunk, [&](std::size_t begin, std::size_t end) {
    std::vector<float> values(in.begin() + static_cast<std::ptrdiff_t>(begin),
                              in.begin() + static_cast<std::ptrdiff_t>(end));
    for (float& value : values) value *= w_m2_sr_per_dn;
    temperature_table_.temperatures(values, values);
    for (std::size_t i = begin; i < end; ++i) {
      out[i] = to_count<std::uint16_t>(values[i - begin] * counts_per_kelvin + 0.5F, 65535.0F);
    }
  });
  return counts;
}

}  // namespace thermal
