#pragma once

#include <cstdint>

#include "base/image.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// The detail of a picture: its counts minus an edge-preserving base, the guided filter of the picture by itself (He,
/// Sun and Tang, ECCV 2010; for infrared pictures Liu and Zhao, Infrared Physics & Technology 67, 2014): windows whose
/// standard deviation is far below `edge_counts` are smoothed to their mean, those far above keep their edges. Edge
/// pixels are replicated beyond the border.
void find_detail(const Plane<std::uint16_t>& ir16, int radius_px, double edge_counts,
                 Plane<float>& detail_counts);

/// Sharpens 8-bit frames, which cameras do in the 8-bit output alone (FLIR's "digital detail enhancement"): adds the
/// detail of their 16-bit frames, minus the part that noise explains, times a gain.
class DetailEnhancer {
 public:
  DetailEnhancer(const AgcParameters& parameters, double counts_per_netd);

  /// A pixel of detail d, in NETDs, becomes gain x (|d| - noise) levels warmer, or colder if d < 0; unchanged if |d| is
  /// at most `noise`; clipped to black_level and white_level. Counts 0 (no signal) and 65535 (clipped) are unchanged,
  /// as is everything without a gain.
  void sharpen(const Plane<std::uint16_t>& ir16, Plane<std::uint8_t>& ir8);

 private:
  DetailParameters parameters_;
  bool is_inverted_;
  float darkest_;
  float brightest_;
  double counts_per_netd_;
  Plane<float> detail_counts_;
};

}  // namespace thermal
