#include "bench/sensor_suite.h"

#include "base/parallel.h"
#include "bench/detector_rows.h"
#include "bench/flicker_rows.h"
#include "bench/optics_rows.h"
#include "bench/picture_rows.h"
#include "bench/tone_rows.h"
#include "bench/video_rows.h"

namespace thermal {

std::vector<StageRow> run_sensor_suite() {
  return with_threads(1, [&] {
    std::vector<StageRow> rows = optics_rows();
    for (const auto& part : {detector_rows(), flicker_rows(), picture_rows(), tone_rows(), video_rows()}) {
      rows.insert(rows.end(), part.begin(), part.end());
    }
    return rows;
  });
}

}  // namespace thermal
