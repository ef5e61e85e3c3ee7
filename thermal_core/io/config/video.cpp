#include "io/config/video.h"

namespace thermal {

ProcessingParameters read_processing(const Json& processing) {
  return {.noise_filter_sigma_px = processing["noise_filter_sigma_px"],
          .unsharp_amount = processing["unsharp_amount"],
          .unsharp_sigma_px = processing["unsharp_sigma_px"]};
}

AnalogueLinkParameters read_link(const Json& link) {
  const bool is_pal = link["standard"] == "pal";
  const Json& deinterlace = link["deinterlace"];
  return {.field_rate_hz = is_pal ? 50 : 60 / 1.001,
          .active_line_us = is_pal ? 52 : 52.66,
          .lines = link["lines"] == "frame" ? 0
                   : is_pal                 ? 576
                                            : 480,
          .bandwidth_mhz = link["bandwidth_mhz"],
          .deinterlace = deinterlace == "bob"     ? Deinterlace::bob
                         : deinterlace == "blend" ? Deinterlace::blend
                                                  : Deinterlace::weave,
          .noise_levels = link["noise_levels"],
          .streak_levels = link["streak_levels"],
          .streak_us = link["streak_us"],
          .row_levels = link["row_levels"],
          .drift_levels = link["drift_levels"],
          .drift_rows = link["drift_rows"],
          .hum_levels = link["hum_levels"],
          .hum_hz = link["hum_hz"],
          .jitter_px = link["jitter_px"],
          .dropouts_per_s = link["dropouts_per_s"],
          .dropout_us = link["dropout_us"]};
}

}  // namespace thermal
