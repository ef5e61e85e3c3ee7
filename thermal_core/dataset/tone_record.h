#pragma once

#include <string>

#include "io/json_file.h"
#include "sensor/agc.h"

namespace thermal {

/// What frames.jsonl says of how a frame's 8 bits came from its 16: the mode, its parameters, and the thresholds,
/// which tell it exactly (see ToneCurve).
[[nodiscard]] Json tone_record(const ToneCurve& curve, const AgcParameters& agc, float brightest_w_m2_sr);

/// As configs spell it.
[[nodiscard]] std::string mode_name(AgcMode mode);

}  // namespace thermal
