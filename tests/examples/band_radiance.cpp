// The radiance that a camera's band receives from a blackbody, and the temperature that a radiance stands for.
#include <cstdio>

#include <veldt/radiometry/band_radiance.h>

int main() {
  const thermal::BandRadiance band(thermal::SpectralResponse::flat(8, 14));  // um

  for (const double temperature_k : {200.0, 273.15, 300.0, 350.0, 1000.0}) {
    const thermal::BandValue value = band.evaluate(temperature_k);
    const double radiance = value.radiance_w_m2_sr;
    std::printf("%7.2f K emits %15.10f W m^-2 sr^-1, %.4f %% more for each mK; that radiance means %.6f K\n",
                temperature_k, radiance, 0.1 * value.derivative_w_m2_sr_k / radiance,
                band.temperature(radiance));
  }

  // Grass emits 95.8 % of that and, if it reflects nothing, looks colder than it is.
  const double apparent_k = band.temperature(0.958 * band.radiance(273.15));
  std::printf("grass of 273.15 K looks like %.3f K\n", apparent_k);
}
