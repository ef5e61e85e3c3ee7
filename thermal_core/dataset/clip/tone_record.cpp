#include "dataset/clip/tone_record.h"

namespace thermal {

std::string mode_name(AgcMode mode) {
  switch (mode) {
    case AgcMode::scene_max:
      return "scene_max";
    case AgcMode::table_max:
      return "table_max";
    case AgcMode::linear:
      return "linear";
    case AgcMode::percentile:
      return "percentile";
    case AgcMode::plateau:
      return "plateau";
    case AgcMode::information:
      return "information";
    case AgcMode::clahe:
      return "clahe";
  }
  return "";
}

Json tone_record(const ToneCurve& curve, const AgcParameters& agc, float brightest_w_m2_sr) {
  Json record = {{"mode", mode_name(agc.mode)},
                 {"polarity", agc.polarity == Polarity::black_hot ? "black_hot" : "white_hot"},
                 {"low_k", curve.low_k},
                 {"high_k", curve.high_k}};
  if (agc.mode == AgcMode::scene_max || agc.mode == AgcMode::table_max) {
    record["brightest_w_m2_sr"] = brightest_w_m2_sr;
  }
  if (!curve.is_local) record["thresholds"] = curve.thresholds;
  return record;
}

}  // namespace thermal
