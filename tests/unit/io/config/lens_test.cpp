#include "io/config/lens.h"

#include "base/error.h"
#include "io/config/config.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace lens_config_test {

using namespace thermal;

namespace {

/// A camera of 201 x 1 px whose last pixel's centre is at x = 1: focal length 1 mm, pitch 10 um.
Json config_with(const std::string& distortion, const std::string& render = R"({"engine": "blender"})") {
  return parse_json(R"({"name": "night", "clips": [{"id": "a", "season": "winter", "frames": 3}],
                        "camera": {"width_px": 201, "height_px": 1, "focal_length_m": 0.001,
                                   "pixel_pitch_um": 10, "distortion": )" +
                        distortion + R"(}, "render": )" + render + "}",
                    "");
}

ResolvedConfig resolved(const Json& document) { return resolve_config(document, "night.json", kAssets); }

std::string fault_in(const Json& document) {
  return message_of<ConfigError>([&] { (void)resolved(document); });
}

}  // namespace

TEST_CASE("A config without distortion has a pinhole, and needs no overscan") {
  const ResolvedConfig config = resolved(config_with("{}"));
  CHECK(config.spec.settings->distortion.is_none());
  CHECK(config.spec.overscan_px == 0);
  CHECK(config.document["camera"]["distortion"].dump() == R"({"k1":0,"k2":0,"p1":0,"p2":0,"k3":0})");
  CHECK(config.document["render"]["overscan_px"] == 0);
}

TEST_CASE("A lens in mm takes the place of the focal length, whatever the preset's is") {
  Json document =
      parse_json(R"({"name": "night", "camera": {"lens_mm": 19}, "sensor": {"preset": "boson_640_14mm"},
      "clips": [{"id": "a", "season": "winter", "frames": 3},
                {"id": "b", "season": "winter", "frames": 3, "camera": {"lens_mm": 25}}]})",
                 "");
  const ResolvedConfig config = resolved(document);
  CHECK(config.document["camera"]["focal_length_m"] == 0.019);
  CHECK_FALSE(config.document["camera"].contains("lens_mm"));
  CHECK_THAT(config.spec.settings->camera.fx_px, WithinRel(0.019 / 12e-6, 1e-12));
  CHECK_THAT(config.spec.clips[1].settings->camera.fx_px, WithinRel(0.025 / 12e-6, 1e-12));
  CHECK(resolved(config.document).document == config.document);
  document["camera"]["focal_length_m"] = 0.019;
  CHECK(fault_in(document) ==
        "night.json: camera.focal_length_m = 0.019 m; expected none beside camera.lens_mm, which is the same "
        "in mm");
  document["camera"] = {{"lens_mm", 0.019}};
  CHECK(fault_in(document) ==
        "night.json: camera.lens_mm = 0.019 mm; expected at least 1 and at most 1000 mm");
}

TEST_CASE("Each coefficient is read into its own") {
  const ResolvedConfig config =
      resolved(config_with(R"({"k1": -0.1, "k2": 0.02, "p1": 0.003, "p2": -0.004, "k3": 0.05})"));
  CHECK(config.spec.settings->distortion ==
        LensDistortion{.k1 = -0.1, .k2 = 0.02, .p1 = 0.003, .p2 = -0.004, .k3 = 0.05});
}

TEST_CASE("Overscan is what the lens needs, unless the config sets more") {
  // 1.25 (1 + k1 1.25^2) = 1 for k1 = -0.128: the last pixel shows what is 25 px beyond it.
  const ResolvedConfig config = resolved(config_with(R"({"k1": -0.128})"));
  CHECK(config.spec.overscan_px == 25);
  CHECK(config.document["render"]["overscan_px"] == 25);
  CHECK(resolved(config.document).document == config.document);
  CHECK(resolved(config_with(R"({"k1": -0.128})", R"({"engine": "blender", "overscan_px": 40})"))
            .spec.overscan_px == 40);
  CHECK(resolved(config_with("{}", R"({"engine": "blender", "overscan_px": 40})")).spec.overscan_px == 40);
}

TEST_CASE(
    "Embree's rays follow the lens: there is no overscan, but the place is planned as far as the lens sees") {
  const ResolvedConfig config = resolved(config_with(R"({"k1": -0.128})", R"({"engine": "embree"})"));
  CHECK(config.spec.overscan_px == 0);
  CHECK(config.spec.view_margin_px == 25);
  CHECK(config.document["render"]["overscan_px"] == 0);
  CHECK(resolved(config.document).document == config.document);
  CHECK(fault_in(config_with(R"({"k1": -0.128})", R"({"engine": "embree", "overscan_px": 25})")) ==
        "night.json: render.overscan_px = 25 px; expected none with the engine embree, whose rays follow the "
        "lens");
  CHECK(fault_in(config_with(R"({"k1": -1})", R"({"engine": "embree"})")) ==
        fault_in(config_with(R"({"k1": -1})")));
}

TEST_CASE("The place is planned as far as Blender's passes reach") {
  CHECK(resolved(config_with(R"({"k1": -0.128})")).spec.view_margin_px == 25);
  CHECK(resolved(config_with("{}", R"({"engine": "blender", "overscan_px": 40})")).spec.view_margin_px == 40);
  CHECK(resolved(config_with("{}")).spec.view_margin_px == 0);
}

TEST_CASE("Too little overscan is an error, and so is a lens that folds the picture over") {
  CHECK(
      fault_in(config_with(R"({"k1": -0.128})", R"({"engine": "blender", "overscan_px": 24})")) ==
      "night.json: render.overscan_px = 24 px; expected at least 25 px for camera.distortion, or none given");
  CHECK(fault_in(config_with(R"({"k1": -1})")) ==
        "night.json: camera.distortion = k1 -1, k2 0, p1 0, p2 0, k3 0; expected a distortion that is one to "
        "one as "
        "far as the corners of the picture");
}

namespace {

/// Of a camera of 201 x 101 px.
constexpr const char* kCalibration = R"(%YAML:1.0
---
image_width: 201
image_height: 101
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 200., 0., 98., 0., 210., 52., 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ -0.25, 0.125, 0.001, -0.002, 0.0625 ]
)";

std::string changed(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

Json small_camera() {
  Json document = config_with("{}");
  document["camera"]["height_px"] = 101;
  return document;
}

/// A config of such a camera, and the calibration it names.
struct Calibrated {
  explicit Calibrated(const std::string& calibration = kCalibration)
      : file(folder.file("cal.yml", calibration).string()), document(small_camera()) {
    document["camera"]["calibration"] = file;
  }

  TestFolder folder;
  std::string file;
  Json document;
};

}  // namespace

TEST_CASE("Without focal lengths and a principal point a camera is square and centred") {
  const Json camera = resolved(small_camera()).document["camera"];
  CHECK_FALSE(gives_intrinsics(camera));
  CHECK_FALSE(camera.contains("fx_px"));
  const CameraIntrinsics pinhole = read_intrinsics(camera);
  CHECK(pinhole.fx_px == 0.001 / (10 * 1e-6));
  CHECK(pinhole.fy_px == pinhole.fx_px);
  CHECK(pinhole.cx_px == 100.5);
  CHECK(pinhole.cy_px == 50.5);
}

TEST_CASE("What is given of the camera goes before focal length and middle") {
  Json document = small_camera();
  document["camera"].update({{"fx_px", 210}, {"cx_px", 90.5}});
  CameraIntrinsics pinhole = read_intrinsics(resolved(document).document["camera"]);
  CHECK(pinhole.fx_px == 210);
  CHECK(pinhole.fy_px == 210);
  CHECK(pinhole.cx_px == 90.5);
  CHECK(pinhole.cy_px == 50.5);
  document["camera"].update({{"fy_px", 205}, {"cy_px", 60}});
  pinhole = read_intrinsics(resolved(document).document["camera"]);
  CHECK(pinhole.fy_px == 205);
  CHECK(pinhole.cy_px == 60);
  CHECK(gives_intrinsics(document["camera"]));
}

TEST_CASE("A calibration's numbers take the place of its name") {
  const Calibrated one;
  const ResolvedConfig config = resolved(one.document);
  const Json& camera = config.document["camera"];
  CHECK_FALSE(camera.contains("calibration"));
  CHECK(camera["fx_px"] == 200);
  CHECK(camera["fy_px"] == 210);
  CHECK(camera["cx_px"] == 98.5);
  CHECK(camera["cy_px"] == 52.5);
  CHECK(config.spec.settings->distortion ==
        LensDistortion{.k1 = -0.25, .k2 = 0.125, .p1 = 0.001, .p2 = -0.002, .k3 = 0.0625});
  CHECK(config.spec.overscan_px == overscan_px(read_intrinsics(camera), config.spec.settings->distortion));
  CHECK(config.spec.overscan_px > 0);
  CHECK(resolved(config.document).document == config.document);
}

TEST_CASE("A calibration is named relative to the config") {
  const Calibrated one;
  Json document = one.document;
  document["camera"]["calibration"] = "cal.yml";
  root_files(document, one.folder.path());
  CHECK(resolved(document).spec.settings->distortion.k1 == -0.25);
}

TEST_CASE("A calibration that is not there, or of another size of picture, is a fault") {
  Calibrated one(changed(kCalibration, "201", "202"));
  CHECK(
      fault_in(one.document) ==
      "night.json: camera.calibration: " + one.file +
          ": size of the picture = 202 x 101 px; expected 201 x 101 px, camera.width_px x camera.height_px");
  one.document["camera"]["calibration"] = "/nowhere/cal.yml";
  CHECK(fault_in(one.document) ==
        "night.json: camera.calibration: cannot read /nowhere/cal.yml: no such file");
}

TEST_CASE("A calibration that a config must not hold is a fault with its name") {
  const auto fault_with = [](const std::string& from, const std::string& to) {
    const Calibrated one(changed(kCalibration, from, to));
    const std::string fault = fault_in(one.document);
    const std::string begin = "night.json: camera.calibration: " + one.file + ": ";
    REQUIRE(fault.starts_with(begin));
    return fault.substr(begin.size());
  };
  CHECK(fault_with("98.", "201.") == "camera.cx_px = 201.5 px; expected 0 to 201 px, within the picture");
  CHECK(fault_with("52.", "-1.") == "cy_px = -0.5 px; expected at least 0 and at most 8192 px");
  CHECK(fault_with("200.", "0.") == "fx_px = 0.0 px; expected at least 1 and at most 1000000 px");
  CHECK(fault_with("210.", "2001.") ==
        "camera.fy_px = 2001 px; expected 20 to 2000 px, a tenth to ten times camera.fx_px");
  CHECK(fault_with("0.125", "2e5") == "distortion.k2 = 200000.0; expected at least -1000 and at most 1000");
  CHECK(fault_with("-0.25", "-4.") ==
        "camera.distortion = k1 -4, k2 0.125, p1 0.001, p2 -0.002, k3 0.0625; expected a distortion that is "
        "one "
        "to one as far as the corners of the picture");
  CHECK(fault_with("camera_matrix:", "matrix:") ==
        "camera_matrix is missing; expected one of camera_matrix, cameraMatrix, Camera_Matrix, K, k");
}

TEST_CASE("What a calibration gives is not given besides") {
  Calibrated one;
  one.document["camera"].update({{"cx_px", 100}, {"distortion", {{"k1", 0}, {"p2", 0.5}}}});
  CHECK(fault_in(one.document) ==
        "night.json: camera.cx_px = 100 px; expected none beside camera.calibration\n"
        "night.json: camera.distortion.p2 = 0.5; expected none beside camera.calibration");
}

TEST_CASE("A principal point outside the picture is a fault") {
  Json document = small_camera();
  document["camera"].update({{"cx_px", 202}});
  CHECK(fault_in(document) == "night.json: camera.cx_px = 202 px; expected 0 to 201 px, within the picture");
}

}  // namespace lens_config_test
