#pragma once

#include <string>

#include "io/json/file.h"
#include "sensor/agc.h"

namespace thermal {

/// The entry of frames.jsonl on how a frame's 8 bits were made from its 16: the mode, its parameters, and the
/// thresholds, which define it exactly (see ToneCurve). There are none in mode clahe.
[[nodiscard]] Json tone_record(const ToneCurve& curve, const AgcParameters& agc, float brightest_w_m2_sr);

/// Spelled as in configs.
[[nodiscard]] std::string mode_name(AgcMode mode);

}  // namespace thermal
