#include <cmath>
#include <initializer_list>

#include "fuzz/targets.h"
#include "io/config/calibration_file.h"

namespace {

void demand_finite(std::initializer_list<double> numbers) {
  for (const double number : numbers) demand(std::isfinite(number), "a calibration's numbers are finite");
}

}  // namespace

void fuzz::calibration(Bytes bytes) {
  tolerate([bytes] {
    const auto& [camera, lens] = thermal::parse_calibration(text_of(bytes), "calibration");
    demand(camera.width_px > 0 && camera.height_px > 0, "a calibration has a size of picture");
    demand_finite({camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px, lens.k1, lens.k2, lens.p1, lens.p2,
                   lens.k3});
  });
}
