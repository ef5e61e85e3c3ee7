#include "sensor/thermal_camera.h"

#include <array>
#include <cassert>
#include <numbers>
#include <utility>

#include "base/clones.h"
#include "base/parallel.h"
#include "base/rng.h"
#include "radiometry/band_radiance.h"
#include "radiometry/planck.h"
#include "sensor/streams.h"
#include "sensor/vector_math.h"

namespace thermal {
namespace {

constexpr double kNetdTemperatureK = 300;  // at which a NETD is stated
constexpr double kHottestSceneK = 6000;
constexpr float kLargestCount = 65535;
constexpr std::size_t kPixelsPerChunk = 16384;
constexpr std::size_t kPixelsABlock = FlickerNoise::kBlockPixels;

float netd_w_m2_sr(const SensorParameters& parameters) {
  const BandValue at_300_k = BandRadiance(parameters.response).evaluate(kNetdTemperatureK);
  return static_cast<float>(parameters.noise.amount * parameters.netd_k() * at_300_k.derivative_w_m2_sr_k);
}

AgcScene agc_scene(const SensorParameters& parameters, double frame_rate_hz, float brightest_w_m2_sr) {
  return {.kelvin_per_count = parameters.kelvin_per_count,
          .frame_rate_hz = frame_rate_hz,
          .netd_k = parameters.netd_k(),
          .brightest_w_m2_sr = static_cast<double>(brightest_w_m2_sr),
          .temperature_of = [band = BandRadiance(parameters.response)](double radiance) {
            return band.temperature(radiance);
          }};
}

/// NaN compares false: 0.
VELDT_CLONES void copy_clipped(const float* in, std::size_t count, float most, float* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const float value = in[i] > 0.0F ? in[i] : 0.0F;
    out[i] = value < most ? value : most;
  }
}

/// The signal becomes the state.
VELDT_CLONES void follow(float* signal, std::size_t count, float share, float* state) {
  for (std::size_t i = 0; i < count; ++i) signal[i] = state[i] += share * (signal[i] - state[i]);
}

/// Rounds to counts, with an offset to all values but 0, which is no light.
VELDT_CLONES void round_to_counts(const float* in, std::size_t count, float offset, float counts_per_unit,
                                  std::uint16_t* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const float light = in[i] > 0.0F ? in[i] + offset : 0.0F;  // NaN compares false: 0
    const float value = light * counts_per_unit + 0.5F;
    const float positive = value > 0.0F ? value : 0.0F;
    out[i] = static_cast<std::uint16_t>(
        static_cast<std::int32_t>(positive < kLargestCount ? positive : kLargestCount));
  }
}

/// Sum, and sum of squares about a reference value, of a chunk of pixels.
struct Moments {
  double sum = 0;
  double squares = 0;
};

struct MeanAndDeviation {
  double mean = 0;
  double deviation = 0;
};

/// Of all pixels; the order of summation depends on the size of the picture alone.
MeanAndDeviation statistics_of(const Plane<float>& picture) {
  const auto pixels = picture.pixels();
  const double middle = static_cast<double>(pixels.front());  // any value of the picture's order of magnitude
  std::vector<Moments> chunks((pixels.size() + kPixelsPerChunk - 1) / kPixelsPerChunk);
  parallel_for(pixels.size(), kPixelsPerChunk, [&](std::size_t begin, std::size_t end) {
    Moments& moments = chunks[begin / kPixelsPerChunk];
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
  return {.mean = middle + mean, .deviation = std::sqrt(std::max(0.0, total.squares / count - mean * mean))};
}

/// Uniform in +-half width, the paper's fixed pattern.
std::vector<float> uniform_pattern(std::uint32_t seed, const std::string& clip, double half_width,
                                   std::size_t pixels) {
  std::vector<float> pattern(pixels);
  fill_uniform({.seed = seed, .stream = kFirstFramePatternStream, .clip = hash_name(clip), .frame = 0}, 0,
               pattern);
  for (float& value : pattern) value = static_cast<float>(half_width) * (2 * value - 1);
  return pattern;
}

/// Mean square of the drift's growth over a shutter interval, (sqrt(t) / 2 + t / 2)^2 for t from 0 to 1; see
/// PatternNoise.
constexpr double kDriftGrowth2 = 49.0 / 120;

/// Variance of a pixel's noise in units of that of its white noise; see ThermalCamera::noise_w_m2_sr().
double noise_variance(const SensorParameters& parameters, double native_rate_hz) {
  const NoiseParameters& ratios = parameters.noise;
  double variance = 1;
  for (const double ratio : {ratios.fixed_pattern_ratio, ratios.row_ratio, ratios.column_ratio,
                             ratios.temporal_row_ratio, ratios.temporal_column_ratio, ratios.banding_ratio}) {
    variance += ratio * ratio;
  }
  if (ratios.flicker_knee_hz > 0)
    variance +=
        ratios.flicker_knee_hz * FlickerDesign::fit(native_rate_hz, ratios.flicker_knee_hz).variance();
  if (parameters.shutter.interval_s > 0) variance += kDriftGrowth2 * ratios.drift_ratio * ratios.drift_ratio;
  return variance;
}

/// Apparent temperature [K] at which pixels saturate.
double saturation_of(const SensorParameters& parameters) {
  const double end_k = (static_cast<double>(kLargestCount) + 1) * parameters.kelvin_per_count;
  return parameters.saturation_k > 0 ? std::min(parameters.saturation_k, end_k) : end_k;
}

Housing housing_of(const SensorParameters& parameters, const ThermalCamera::Clip& clip) {
  const BandRadiance band(parameters.response);
  const HousingParameters& housing = parameters.housing;
  return {housing,
          parameters.noise.amount,
          clip.seed,
          clip.id,
          clip.width_px,
          clip.height_px,
          band.radiance(clip.air_k + housing.excess_k),
          band.evaluate(kNetdTemperatureK).derivative_w_m2_sr_k};
}

}  // namespace

std::function<double(double temperature_k)> radiance_of(RadianceModel model,
                                                        const SpectralResponse& response) {
  if (model == RadianceModel::script) return script_radiance;
  return [band = BandRadiance(response)](double temperature_k) { return band.radiance(temperature_k); };
}

std::function<double(double temperature_k)> radiance_of(const SensorParameters& parameters) {
  return radiance_of(parameters.radiance, parameters.response);
}

std::shared_ptr<const TemperatureTable> apparent_temperatures(const SpectralResponse& response) {
  constexpr double kColdest = 180;
  constexpr double kWarmest = 420;
  constexpr double kHottest = 2000;
  const BandRadiance band(response);
  const double low = band.radiance(kColdest);
  const double high = band.radiance(kWarmest);
  return std::make_shared<const TemperatureTable>(
      [band](double radiance) { return band.temperature(radiance); }, low, high, band.radiance(kHottest));
}

ThermalCamera::ThermalCamera(const SensorParameters& parameters, Clip clip, float brightest_w_m2_sr,
                             std::shared_ptr<const TemperatureTable> temperatures)
    : parameters_(parameters),
      clip_(std::move(clip)),
      clip_hash_(hash_name(clip_.id)),
      brightest_w_m2_sr_(static_cast<double>(brightest_w_m2_sr)),
      temperatures_(temperatures ? std::move(temperatures) : apparent_temperatures(parameters.response)),
      native_(NativeRate::of(parameters.native_rate_hz, clip_.frame_rate_hz)),
      white_w_m2_sr_(netd_w_m2_sr(parameters)),
      fast_w_m2_sr_(white_w_m2_sr_),
      flicker_w_m2_sr_(white_w_m2_sr_ * static_cast<float>(std::sqrt(parameters.noise.flicker_knee_hz))),
      brightest_taken_w_m2_sr_(
          static_cast<float>(BandRadiance(parameters.response).radiance(kHottestSceneK))),
      saturation_w_m2_sr_(
          static_cast<float>(BandRadiance(parameters.response).radiance(saturation_of(parameters)))),
      follow_(parameters.time_constant_s > 0
                  ? static_cast<float>(-std::expm1(-1 / (clip_.frame_rate_hz * parameters.time_constant_s)))
                  : 1),
      optics_(parameters.optics, parameters.response, clip_.sampling),
      shutter_(parameters.shutter, clip_.seed, clip_.id),
      radiometric_error_(parameters.accuracy_k, clip_.seed, clip_.id),
      pattern_(parameters.noise, clip_.seed, clip_.id, clip_.width_px, clip_.height_px),
      housing_(housing_of(parameters, clip_)),
      bad_pixels_(parameters.bad_pixels, clip_.seed, clip_.id, native_.rate_hz, clip_.width_px,
                  clip_.height_px),
      processing_(parameters.processing),
      agc_(parameters.agc, agc_scene(parameters, clip_.frame_rate_hz, brightest_w_m2_sr)),
      sharpener_(parameters.agc, parameters.netd_k() / parameters.kelvin_per_count),
      signal_(clip_.width_px, clip_.height_px),
      noise_w_m2_sr_(static_cast<double>(white_w_m2_sr_) *
                     std::sqrt(noise_variance(parameters, native_.rate_hz))) {
  assert(brightest_w_m2_sr > 0);
  const double interval_s = 1 / clip_.frame_rate_hz;
  if (parameters.time_constant_s > 0)
    smear_.emplace(interval_s, parameters.time_constant_s, std::min(parameters.readout_s, interval_s));
  if (parameters.denoise.share_of_new < 1) denoise_.emplace(parameters.denoise, white_w_m2_sr_);
  if (flicker_w_m2_sr_ > 0) {
    const double knee_hz = parameters.noise.flicker_knee_hz;
    const FlickerDesign design = FlickerDesign::fit(native_.rate_hz, knee_hz);
    fast_w_m2_sr_ *= static_cast<float>(std::sqrt(1 + knee_hz * design.white_variance));
    flicker_.emplace(clip_.seed, clip_.id, design, signal_.size());
  }
}

SensorFrame ThermalCamera::expose(const Plane<float>& radiance_w_m2_sr) {
  SensorFrame frame;
  expose(radiance_w_m2_sr, frame);
  return frame;
}

double ThermalCamera::temperature_k(double radiance_w_m2_sr) const {
  const auto radiance = static_cast<float>(radiance_w_m2_sr);
  float temperature_k = 0;
  temperatures_->temperatures(std::span(&radiance, 1), std::span(&temperature_k, 1));
  return static_cast<double>(temperature_k);
}

double ThermalCamera::noise_w_m2_sr(int x_px, int y_px) const {
  const double gain = clip_.noise_gain.empty() ? 1 : static_cast<double>(clip_.noise_gain.at(x_px, y_px));
  return std::hypot(gain * std::hypot(noise_w_m2_sr_, first_frame_w_m2_sr_ / std::numbers::sqrt3),
                    gain_w_m2_sr_);
}

void ThermalCamera::expose(const Plane<float>& radiance_w_m2_sr, SensorFrame& out,
                           const TakeSignal& take_signal) {
  expose(radiance_w_m2_sr, {}, {}, out, take_signal);
}

void ThermalCamera::expose(const Plane<float>& radiance_w_m2_sr, const SubpixelDetail& detail,
                           const ImageMotion& motion, SensorFrame& out, const TakeSignal& take_signal) {
  const std::uint32_t native = frame_++ * native_.step;
  take_in(radiance_w_m2_sr, detail);
  if (take_signal) take_signal(signal_);
  if (smear_ && begun_) smear_->apply(motion, signal_);
  if (smear_ && !begun_) smear_->apply_to_first(motion, signal_);
  if (!begun_) begin();
  const std::uint32_t shown = shown_at(native);
  if (seen_ && shown <= *seen_) {  // closed since then
    for_blocks([&](std::size_t first, std::span<float> block) { lag(first, block); });
    out = shown_;
  } else {
    make_picture(shown, out);
    if (shutter_.at(frame_ * native_.step / native_.rate_hz).closed) shown_ = out;
  }
  seen_ = native;
  out.shutter_closed = shutter_.at(native / native_.rate_hz).closed;
}

std::uint32_t ThermalCamera::shown_at(std::uint32_t native) const noexcept {
  std::uint32_t shown = native;
  while (shown > seen_.value_or(0)) {
    const ShutterState shutter = shutter_.at(shown / native_.rate_hz);
    if (!shutter.closed) break;
    const std::uint32_t closing = shutter_.first_frame(shutter.event, native_.rate_hz);
    shown = closing > 0 ? closing - 1 : 0;
  }
  return shown;
}

/// Makes pictures of the detector's signal at a native frame.
void ThermalCamera::make_picture(std::uint32_t native, SensorFrame& out) {
  const double time_s = native / native_.rate_hz;
  const ShutterState shutter = shutter_.at(time_s);
  pattern_.begin_frame(native, time_s, shutter);
  housing_.begin_frame(shutter);
  if (flicker_ && event_ != shutter.event)
    flicker_->restart_at(shutter_.first_frame(shutter.event, native_.rate_hz), shutter.event);
  if (denoise_ && event_ && *event_ != shutter.event) denoise_->restart();
  event_ = shutter.event;
  for_blocks([&](std::size_t first, std::span<float> block) {
    lag(first, block);
    housing_.apply(first, block);
    add_noise(native, first, block);
  });
  bad_pixels_.apply(native, white_w_m2_sr_, signal_);
  if (denoise_) denoise_->apply(signal_);
  count(radiometric_error_.at_k(shutter), out.ir16);
  show(out);
}

void ThermalCamera::show(SensorFrame& frame) {
  const AgcParameters& agc = parameters_.agc;
  const Plane<std::uint16_t>& filtered = processing_.filter(frame.ir16);
  frame.curve = agc_.next(filtered);
  if (agc.mode == AgcMode::table_max) {
    truncate_to_levels(signal_, brightest_w_m2_sr_, agc.polarity, frame.ir8);
  } else {
    agc_.show(filtered, frame.ir8);
  }
  sharpener_.sharpen(filtered, frame.ir8);
}

/// Radiance at the detector, behind the optics.
void ThermalCamera::take_in(const Plane<float>& radiance_w_m2_sr, const SubpixelDetail& detail) {
  assert(radiance_w_m2_sr.size() == signal_.size());
  assert(detail.empty() || clip_.sampling.quarters);
  const auto in = radiance_w_m2_sr.pixels();
  const auto signal = signal_.pixels();
  parallel_for(in.size(), kPixelsPerChunk, [&](std::size_t begin, std::size_t end) {
    copy_clipped(&in[begin], end - begin, brightest_taken_w_m2_sr_, &signal[begin]);
  });
  optics_.apply(detail, signal_);
}

/// Initial states, at the first exposed frame.
void ThermalCamera::begin() {
  const auto signal = signal_.pixels();
  begun_ = true;
  if (follow_ < 1) membrane_.assign(signal.begin(), signal.end());  // in equilibrium
  if (housing_.has_gain()) gain_w_m2_sr_ = housing_.pixel_stddev_w_m2_sr(statistics_of(signal_).mean);
  const double ratio = parameters_.noise.amount * parameters_.noise.first_frame_ratio;
  if (ratio > 0) {
    first_frame_w_m2_sr_ = ratio * statistics_of(signal_).deviation;
    first_frame_ = uniform_pattern(clip_.seed, clip_.id, first_frame_w_m2_sr_, signal_.size());
  }
}

void ThermalCamera::lag(std::size_t first, std::span<float> signal) {
  if (!membrane_.empty()) follow(signal.data(), signal.size(), follow_, &membrane_[first]);
}

/// Processes the signal in blocks that stay in the L1 cache.
template <typename Work>
void ThermalCamera::for_blocks(const Work& work) {
  const auto signal = signal_.pixels();
  parallel_for(signal.size(), kPixelsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += kPixelsABlock)
      work(first, signal.subspan(first, std::min(kPixelsABlock, end - first)));
  });
}

void ThermalCamera::add_noise(std::uint32_t native, std::size_t first, std::span<float> signal) {
  std::array<float, kPixelsABlock> buffer;  // NOLINT(*-member-init): filled below
  const std::size_t count = signal.size();
  const std::span<float> noise = std::span(buffer).first(count);
  if (white_w_m2_sr_ > 0) {
    fill_normal({.seed = clip_.seed, .stream = kWhiteStream, .clip = clip_hash_, .frame = native}, first,
                noise);
    scale(fast_w_m2_sr_, noise);
    if (flicker_) flicker_->add(native, first, flicker_w_m2_sr_, noise);
    pattern_.add(first, white_w_m2_sr_, noise);
  } else {
    std::ranges::fill(noise, 0.0F);
  }
  if (!first_frame_.empty()) add_scaled(std::span(first_frame_).subspan(first, count), 1, noise);
  if (!clip_.noise_gain.empty()) multiply(clip_.noise_gain.pixels().subspan(first, count), noise);
  add_scaled(noise, 1, signal);
}

void ThermalCamera::count(double error_k, Plane<std::uint16_t>& ir16) const {
  ir16.resize(clip_.width_px, clip_.height_px);
  const auto counts_per_kelvin = static_cast<float>(1 / parameters_.kelvin_per_count);
  const auto signal = signal_.pixels();
  const auto out = ir16.pixels();
  parallel_for(signal.size(), kPixelsPerChunk, [&](std::size_t begin, std::size_t end) {
    std::array<float, kPixelsABlock> radiances{};
    std::array<float, kPixelsABlock> temperatures_k{};
    for (std::size_t first = begin; first < end; first += kPixelsABlock) {
      const std::size_t size = std::min(kPixelsABlock, end - first);
      copy_clipped(&signal[first], size, saturation_w_m2_sr_, radiances.data());
      temperatures_->temperatures(std::span(radiances).first(size), std::span(temperatures_k).first(size));
      round_to_counts(temperatures_k.data(), size, static_cast<float>(error_k), counts_per_kelvin,
                      &out[first]);
    }
  });
}

}  // namespace thermal
