#include "io/lens_config.h"

#include "base/error.h"
#include "io/config.h"
#include "support/catch.h"
#include "support/message_of.h"

using namespace thermal;

namespace {

/// A camera of 201 x 1 px whose last pixel's centre is at x = 1: focal length 1 mm, pitch 10 um.
Json config_with(const std::string& distortion, const std::string& render = "{}") {
  return parse_json(R"({"name": "night", "clips": [{"id": "a", "season": "winter", "frames": 3}],
                        "camera": {"width_px": 201, "height_px": 1, "focal_length_m": 0.001,
                                   "pixel_pitch_um": 10, "distortion": )" +
                        distortion + R"(}, "render": )" + render + "}",
                    "");
}

Config resolved(const Json& document) { return resolve_config(document, "night.json", VELDT_SOURCE_DIR); }

std::string fault_in(const Json& document) {
  return message_of<ConfigError>([&] { (void)resolved(document); });
}

}  // namespace

TEST_CASE("A config without distortion has a pinhole, and needs no overscan") {
  const Config config = resolved(config_with("{}"));
  CHECK(config.distortion.is_none());
  CHECK(config.overscan_px == 0);
  CHECK(config.resolved["camera"]["distortion"].dump() == R"({"k1":0,"k2":0,"p1":0,"p2":0})");
  CHECK(config.resolved["render"]["overscan_px"] == 0);
}

TEST_CASE("Each coefficient is read into its own") {
  const Config config = resolved(config_with(R"({"k1": -0.1, "k2": 0.02, "p1": 0.003, "p2": -0.004})"));
  CHECK(config.distortion == LensDistortion{.k1 = -0.1, .k2 = 0.02, .p1 = 0.003, .p2 = -0.004});
}

TEST_CASE("Overscan is what the lens needs, unless the config wants more") {
  // 1.25 (1 + k1 1.25^2) = 1 for k1 = -0.128: the last pixel shows what is 25 px beyond it.
  const Config config = resolved(config_with(R"({"k1": -0.128})"));
  CHECK(config.overscan_px == 25);
  CHECK(config.resolved["render"]["overscan_px"] == 25);
  CHECK(resolved(config.resolved).resolved == config.resolved);
  CHECK(resolved(config_with(R"({"k1": -0.128})", R"({"overscan_px": 40})")).overscan_px == 40);
  CHECK(resolved(config_with("{}", R"({"overscan_px": 40})")).overscan_px == 40);
}

TEST_CASE("Too little overscan is a fault, and so is a lens that folds the picture over") {
  CHECK(
      fault_in(config_with(R"({"k1": -0.128})", R"({"overscan_px": 24})")) ==
      "night.json: render.overscan_px = 24 px; expected at least 25 px for camera.distortion, or none given");
  CHECK(
      fault_in(config_with(R"({"k1": -1})")) ==
      "night.json: camera.distortion = k1 -1, k2 0, p1 0, p2 0; expected a distortion that is one to one as "
      "far as the corners of the picture");
}
