// An uncooled camera looks at radiance planes of one's own: an animal of 303 K crosses ground of 278 K. The lens takes
// a little from the animal; the noise, 40 mK at 300 K, is 53 mK on the colder ground with its fixed pattern. Given the
// name of a file, writes the last frame there, as a PGM image.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>

#include <veldt/radiometry/band_radiance.h>
#include <veldt/sensor/thermal_camera.h>

constexpr int kWidth = 160;
constexpr int kHeight = 128;

/// Radiance [W m^-2 sr^-1] of every pixel in one frame.
thermal::Plane<float> scene(const thermal::BandRadiance& band, int number) {
  thermal::Plane<float> plane(kWidth, kHeight, static_cast<float>(band.radiance(278)));
  const auto animal = static_cast<float>(band.radiance(303));
  for (int pixel = 0; pixel < 20 * 12; ++pixel) plane.at(40 + number + pixel % 20, 60 + pixel / 20) = animal;
  return plane;
}

/// Prints mean and standard deviation of the apparent temperature in a square of 8 x 8 pixels.
void print_square(const char* what, const thermal::SensorFrame& frame, int left, int top) {
  double sum_k = 0;
  double squares_k2 = 0;
  for (int pixel = 0; pixel < 64; ++pixel) {
    const double kelvin = 0.01 * frame.ir16.at(left + pixel % 8, top + pixel / 8);
    sum_k += kelvin;
    squares_k2 += kelvin * kelvin;
  }
  const double mean_k = sum_k / 64;
  std::printf("  %s %.2f K +- %.2f K", what, mean_k, std::sqrt(squares_k2 / 64 - mean_k * mean_k));
}

int main(int argc, char** argv) {
  thermal::SensorParameters parameters;
  parameters.response = thermal::SpectralResponse::flat(8, 14);  // um
  parameters.optics.psf = thermal::Psf::physical;
  parameters.netd_mk = 40;
  parameters.noise.fixed_pattern_ratio = 0.35;
  parameters.kelvin_per_count = 0.01;
  parameters.agc.mode = thermal::AgcMode::plateau;
  thermal::ThermalCamera::Clip clip;
  clip.width_px = kWidth;
  clip.height_px = kHeight;

  const thermal::BandRadiance band(parameters.response);
  thermal::ThermalCamera camera(parameters, clip, static_cast<float>(band.radiance(303)));
  thermal::SensorFrame frame;
  for (int number = 0; number < 3; ++number) {
    camera.expose(scene(band, number), frame);
    std::printf("frame %d:", number);
    print_square("animal", frame, 46 + number, 62);
    print_square("ground", frame, 100, 20);
    std::printf("  levels %d, %d\n", frame.ir8.at(50, 66), frame.ir8.at(100, 20));
  }
  if (argc > 1) {
    std::ofstream file(argv[1], std::ios::binary);
    file << "P5 " << kWidth << ' ' << kHeight << " 255\n";
    for (const std::uint8_t level : frame.ir8.pixels()) file.put(static_cast<char>(level));
  }
}
