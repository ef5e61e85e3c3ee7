#include "io/json/camera.h"

namespace thermal {

CameraIntrinsics intrinsics_of(const Json& json) {
  return {.width_px = json.at("width_px"),
          .height_px = json.at("height_px"),
          .fx_px = json.at("fx_px"),
          .fy_px = json.at("fy_px"),
          .cx_px = json.at("cx_px"),
          .cy_px = json.at("cy_px")};
}

Json to_json(const CameraIntrinsics& camera) {
  return {{"width_px", camera.width_px}, {"height_px", camera.height_px}, {"fx_px", camera.fx_px},
          {"fy_px", camera.fy_px},       {"cx_px", camera.cx_px},         {"cy_px", camera.cy_px}};
}

LensDistortion distortion_of(const Json& json) {
  return {.k1 = json.at("k1"),
          .k2 = json.at("k2"),
          .p1 = json.at("p1"),
          .p2 = json.at("p2"),
          .k3 = json.at("k3")};
}

Json to_json(const LensDistortion& lens) {
  return {{"k1", lens.k1}, {"k2", lens.k2}, {"p1", lens.p1}, {"p2", lens.p2}, {"k3", lens.k3}};
}

}  // namespace thermal
