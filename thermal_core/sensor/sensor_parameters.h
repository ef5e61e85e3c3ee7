#pragma once

#include "radiometry/spectral_response.h"

namespace thermal {

/// The model of in-band radiance against temperature.
enum class RadianceModel {
  exact,  ///< Planck's law with SI 2019 constants and the sensor's response
  script  ///< the 600-point trapezoid of the authors' published script, 8-14 um
};

/// Model of the point spread.
enum class Psf {
  gaussian,  ///< a plain Gaussian, as in the paper
  physical   ///< diffraction, the pixel's footprint and a Gaussian for all other imperfections
};

/// Blur by the lens and the pixels.
struct OpticsParameters {
  Psf psf = Psf::gaussian;
  double blur_sigma_px = 1;           ///< gaussian; 0: no blur
  double f_number = 1;                ///< focal length / aperture
  double aberration_sigma_px = 0.25;  ///< physical
  double defocus_um = 0;              ///< physical: distance of the pixels from the plane of focus
  double pixel_pitch_um = 17;         ///< the camera's

  [[nodiscard]] bool operator==(const OpticsParameters&) const = default;
};

/// Noise in the terms of NVESD's three-dimensional model (t time, v rows, h columns), each component as a ratio of
/// its standard deviation to that of the white temporal noise of a pixel (tvh).
struct NoiseParameters {
  double amount = 1;                 ///< factor on all noise; 0: none
  double flicker_knee_hz = 0;        ///< where the 1/f part of a pixel's spectrum equals the white part
  double fixed_pattern_ratio = 0;    ///< vh; drawn anew whenever the shutter closes
  double row_ratio = 0;              ///< v; likewise
  double column_ratio = 0;           ///< h; likewise
  double temporal_row_ratio = 0;     ///< tv
  double temporal_column_ratio = 0;  ///< th
  double frame_ratio = 0;            ///< t
  double drift_ratio = 0;            ///< fixed pattern that has grown one shutter interval after a closing
  double first_frame_ratio = 0;      ///< half width of a uniform pattern / standard deviation of the first
                                     ///< frame, as in the paper
  double banding_ratio = 0;          ///< electronic bands along rows, sinusoidal
  double banding_period_px = 16;     ///< spacing of bands
  double banding_hz = 1;             ///< bands that pass a row per second

  [[nodiscard]] bool operator==(const NoiseParameters&) const = default;
};

/// The shutter that the camera closes to correct its pixels (flat-field correction).
struct ShutterParameters {
  double interval_s = 0;  ///< from closing to closing; 0: no shutter
  double freeze_s = 0.5;  ///< duration of the frozen picture

  [[nodiscard]] bool operator==(const ShutterParameters&) const = default;
};

/// The camera's housing, which the pixels see around the lens; see Housing. Factors of the noise apply here too.
struct HousingParameters {
  double excess_k = 0;          ///< excess over the air around the camera
  double gain_error_share = 0;  ///< standard deviation of the pixels' gains
  double halo_k =
      0;  ///< standard deviation of the halo at the corners one shutter interval after a closing, at 300 K

  [[nodiscard]] bool operator==(const HousingParameters&) const = default;
};

/// Defective pixels.
struct BadPixelParameters {
  double dead_share = 0;          ///< of all pixels; dead pixels measure nothing
  bool replace_dead = true;       ///< by the mean of their working neighbours, as cameras do
  double blinking_share = 0;      ///< of all pixels; they jump up and back
  double blinking_ratio = 10;     ///< height of the jump / white temporal noise
  double blinking_hz = 1;         ///< jumps per second
  double late_dead_per_hour = 0;  ///< share of all pixels that fail during the clip, unknown to the camera

  [[nodiscard]] bool operator==(const BadPixelParameters&) const = default;
};

/// Gain control: mapping from apparent temperature to the 8-bit picture.
enum class AgcMode {
  scene_max,    ///< proportional to radiance; 255 is the most radiant material of the clip, as in the paper
  table_max,    ///< the same; 255 is the most radiant row of Table 1; counts are truncated, as in the script
  linear,       ///< from low_k to high_k
  percentile,   ///< between two percentiles of the frame, damped in time
  plateau,      ///< histogram equalisation with a plateau, damped in time
  information,  ///< the same; pixels without information around them count less
  clahe         ///< histogram equalisation in tiles, with a clip limit, damped in time
};

/// Whether warm objects are bright or dark in the 8-bit frame.
enum class Polarity { white_hot, black_hot };

/// Sharpening of the 8-bit picture.
struct DetailParameters {
  double gain_dn_per_netd = 0;  ///< 8-bit counts added per NETD of detail; 0: none
  int radius_px = 3;            ///< of the window whose mean is subtracted
  double edge_netd = 10;        ///< standard deviation of a window beyond which it holds an edge, not detail
  double noise_netd = 4;        ///< detail below this is taken as noise and not added

  [[nodiscard]] bool operator==(const DetailParameters&) const = default;
};

/// Temporal noise reduction.
struct DenoiseParameters {
  double share_of_new = 1;  ///< weight of a frame in the mean of a pixel, in (0, 1]; 1: no noise reduction
  double motion_sigma = 4;  ///< change, in standard deviations of white noise, that is taken as motion

  [[nodiscard]] bool operator==(const DenoiseParameters&) const = default;
};

/// Filters of the 8-bit frames alone, ahead of gain control; see Processing.
struct ProcessingParameters {
  double noise_filter_sigma_px = 0;  ///< of a Gaussian; 0: none
  double unsharp_amount = 0;         ///< share of the detail that is added; 0: none
  double unsharp_sigma_px = 2;       ///< of its Gaussian

  [[nodiscard]] bool operator==(const ProcessingParameters&) const = default;
};

/// Gain control: how 16-bit frames become 8-bit frames.
struct AgcParameters {
  AgcMode mode = AgcMode::scene_max;
  Polarity polarity = Polarity::white_hot;
  double low_k = 263;   ///< linear: count 0
  double high_k = 313;  ///< linear: count 255
  // Of the adaptive modes, which are those below linear:
  double tail_percent = 0.05;  ///< fraction of the pixels dropped at either end
  double plateau_percent =
      0.07;                   ///< plateau, information: fraction of the pixels; larger bins are clipped to it
  double linear_percent = 0;  ///< plateau, information: of a straight line in their curve
  double max_gain_dn_per_netd = 8;        ///< largest number of 8-bit counts per NETD
  double damping_s = 0.5;                 ///< time constant
  double information_threshold_netd = 3;  ///< information: change across a pixel that exceeds noise
  double flat_weight = 0.1;               ///< information: of pixels with less than that; 1: as plateau
  double clip_limit = 2;                  ///< clahe: largest bin / mean bin of a tile
  int tiles_across = 8;                   ///< clahe
  int tiles_down = 8;                     ///< clahe
  int black_level = 0;                    ///< of the coldest pixels; not in table_max
  int white_level = 255;                  ///< of the warmest
  DetailParameters detail = {};           ///< in all modes

  [[nodiscard]] bool operator==(const AgcParameters&) const = default;
};

/// Parameters of a whole camera.
struct SensorParameters {
  SpectralResponse response = SpectralResponse::flat(8, 14);
  RadianceModel radiance = RadianceModel::exact;
  OpticsParameters optics;
  double time_constant_s = 0;  ///< thermal time constant of a pixel; 0: none
  double readout_s = 0;        ///< from reading the first row to reading the last; 0: simultaneous
  double netd_mk = 40;         ///< white temporal noise of a pixel as a temperature difference at 300 K
  double native_rate_hz = 0;   ///< of the sensor; a video shows every n-th of its frames; 0: every frame
  double netd_f_number = 1;    ///< at which netd_mk is stated
  NoiseParameters noise;
  ShutterParameters shutter;
  HousingParameters housing;
  BadPixelParameters bad_pixels;
  double accuracy_k = 0;  ///< error of all apparent temperatures, see RadiometricError; 0: none
  DenoiseParameters denoise;
  ProcessingParameters processing;
  double kelvin_per_count = 0.01;  ///< step of the 16-bit frames
  double saturation_k = 0;  ///< apparent temperature at which pixels saturate; 0: the maximum of the 16-bit
                            ///< frames
  AgcParameters agc;

  /// NETD [K] with the camera's own lens: a pixel gets the light of a cone whose sine, squared, is 1 / (4 F^2 + 1).
  [[nodiscard]] double netd_k() const noexcept {
    const auto per_light = [](double f_number) { return 4 * f_number * f_number + 1; };
    return 1e-3 * netd_mk * per_light(optics.f_number) / per_light(netd_f_number);
  }
};

}  // namespace thermal
