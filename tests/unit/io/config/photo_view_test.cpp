#include "io/config/photo_view.h"

#include "base/error.h"
#include "io/config/config.h"
#include "io/config/views_file.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace photo_view_test {

using namespace thermal;

namespace {

const std::vector<CameraPreset>& presets() {
  static const std::vector<CameraPreset> all = photographed_presets(kAssets.schema("config"), kAssets);
  return all;
}

/// A photo that lacks nothing, of a place at 18.5 deg south and 26.25 deg east.
PhotoTags mavic() {
  return {.size = {.width_px = 640, .height_px = 512},
          .texts = {{"Make", "DJI"},
                    {"Model", "M3T"},
                    {"Exif:FocalLength", "9.1"},
                    {"Exif:FocalLengthIn35mmFilm", "40"},
                    {"Exif:DateTimeOriginal", "2026:07:09 01:30:00"},
                    {"GPS:DateStamp", "2026:07:08"},
                    {"GPS:TimeStamp", "23 30 0"},
                    {"GPS:Latitude", "18 30 0"},
                    {"GPS:LatitudeRef", "S"},
                    {"GPS:Longitude", "26 15 0"},
                    {"GPS:LongitudeRef", "E"},
                    {"GPS:Altitude", "960.4"},
                    {"GPS:AltitudeRef", "0"},
                    {"drone-dji:ImageSource", "InfraredCamera"},
                    {"drone-dji:RelativeAltitude", "60.1"},
                    {"drone-dji:GimbalPitchDegree", "-45"},
                    {"drone-dji:FlightYawDegree", "30"}}};
}

PhotoView view_of(const PhotoTags& tags) { return read_photo_view(tags, presets()); }

PhotoTags without(PhotoTags tags, std::initializer_list<const char*> names) {
  for (const char* name : names) tags.texts.erase(name);
  return tags;
}

PhotoTags with(PhotoTags tags, const char* name, const char* text) {
  tags.texts[name] = text;
  return tags;
}

}  // namespace

TEST_CASE("A photo of DJI's says its camera, view, place and time") {
  const PhotoView view = view_of(mavic());
  CHECK(view.remarks.empty());
  CHECK(view.camera.dump() == R"({"sensor":{"preset":"dji_mavic_3t"}})");
  CHECK(view.altitude_m == 60.1);
  CHECK(view.look_angle_deg == 45);
  CHECK(view.heading_deg == 60);  // clockwise from north to counter-clockwise from east
  // 23:30 UTC and 26.25 deg / 15 deg an hour: 01:15 of the next day.
  CHECK(view.weather.dump() ==
        R"({"date":"2026-07-09","time":"01:15","latitude_deg":-18.5,"elevation_m":900.0})");
}

TEST_CASE("What a photo says is part of a valid config") {
  const PhotoView view = view_of(mavic());
  Json document = view.camera;
  document["name"] = "night";
  document["weather"] = view.weather;
  document["clips"] = {{{"id", "a"},
                        {"season", "winter"},
                        {"frames", 3},
                        {"flight",
                         {{"pattern", "zigzag"},
                          {"area_m", {-100, -100, 100, 100}},
                          {"altitude_m", *view.altitude_m},
                          {"look_angle_deg", *view.look_angle_deg},
                          {"heading_deg", *view.heading_deg}}}}};
  CHECK_NOTHROW(resolve_config(document, "night.json", kAssets));
}

TEST_CASE("Gimbals overshoot straight down by a degree; above the horizon there is no view") {
  CHECK(view_of(with(mavic(), "drone-dji:GimbalPitchDegree", "-90.4")).look_angle_deg == 90);
  const PhotoView up = view_of(with(mavic(), "drone-dji:GimbalPitchDegree", "+10.00"));
  CHECK_FALSE(up.look_angle_deg);
  CHECK(
      up.remarks ==
      std::vector<std::string>{
          "drone-dji:GimbalPitchDegree = +10.00 deg; expected -91.5 to -1 deg, below the horizon",
          "no drone-dji:GimbalPitchDegree or Camera:Pitch; expected one of them for flight.look_angle_deg"});
}

TEST_CASE("FLIR's photos have fractions, and Pix4D's angle from straight down") {
  PhotoTags tags = {.size = {.width_px = 640, .height_px = 512},
                    .texts = {{"Make", "FLIR"},
                              {"Model", "FLIR Vue Pro R 640 19mm"},
                              {"Exif:FocalLength", "19"},
                              {"FLIR:MAVRelativeAltitude", "61200/1000"},
                              {"FLIR:MAVYaw", "-9000/100"},
                              {"Camera:Pitch", "1500/100"}}};
  const PhotoView view = view_of(tags);
  CHECK(view.camera.dump() == R"({"sensor":{"preset":"flir_vue_pro_r_640_19mm"}})");
  CHECK(view.altitude_m == 61.2);
  CHECK(view.look_angle_deg == 75);
  CHECK(view.heading_deg == 180);
  CHECK(view.weather.empty());
  CHECK(view.remarks ==
        std::vector<std::string>{
            "no drone-dji:GimbalPitchDegree; Camera:Pitch is taken as Pix4D defines it, 0 being "
            "straight down",
            "no GPS:TimeStamp, no Exif:DateTimeOriginal; weather.date and weather.time are left "
            "out"});
  // Without a flight controller, its camera writes a height of 0, and 0/0 is no number.
  tags.texts["FLIR:MAVRelativeAltitude"] = "0/1000";
  CHECK_FALSE(view_of(tags).altitude_m);
  tags.texts["FLIR:MAVRelativeAltitude"] = "61200/0";
  CHECK_FALSE(view_of(tags).altitude_m);
}

TEST_CASE("Tags that are missing are named, with what stands in their place") {
  const PhotoView view =
      view_of(without(mavic(), {"drone-dji:RelativeAltitude", "drone-dji:GimbalPitchDegree", "GPS:TimeStamp",
                                "Exif:FocalLength"}));
  CHECK_FALSE(view.altitude_m);
  CHECK_FALSE(view.look_angle_deg);
  CHECK_FALSE(view.weather.contains("elevation_m"));
  CHECK(view.weather["time"] == "01:30");
  CHECK(view.remarks ==
        std::vector<std::string>{
            "no drone-dji:RelativeAltitude, FLIR:MAVRelativeAltitude or Camera:AboveGroundAltitude; expected "
            "one of "
            "them for flight.altitude_m",
            "no drone-dji:GimbalPitchDegree or Camera:Pitch; expected one of them for flight.look_angle_deg",
            "no GPS:TimeStamp with a place; weather.time is the camera's clock, not solar time",
            "no Exif:FocalLength; the lens is that of the preset dji_mavic_3t"});
}

TEST_CASE("Of several lenses of a camera, the photo's is taken; of another lens, its focal length") {
  const auto camera_of = [](const char* focal_mm) {
    return view_of(with(with(mavic(), "Model", "ZH20N"), "Exif:FocalLength", focal_mm)).camera.dump();
  };
  CHECK(camera_of("12") == R"({"sensor":{"preset":"dji_h20n_wide"}})");
  CHECK(camera_of("44.5") == R"({"sensor":{"preset":"dji_h20n_tele"}})");
  CHECK(camera_of("25") == R"({"sensor":{"preset":"dji_h20n_tele"},"camera":{"lens_mm":25.0}})");
}

TEST_CASE("An enlarged photo keeps the field of view") {
  PhotoTags tags = mavic();
  tags.size = {.width_px = 1280, .height_px = 1024};
  const PhotoView view = view_of(tags);
  CHECK(view.camera["camera"].dump() ==
        R"({"width_px":1280,"height_px":1024,"fx_px":1516.7})");  // 2 x 9.1 mm / 12 um
  CHECK(view.remarks.size() == 1);
}

TEST_CASE("A camera that no preset knows gets the lens of its tags") {
  const PhotoView view = view_of(with(mavic(), "Model", "XT9"));
  // 40 mm on 43.27 mm of film; 819.6 px across the photo.
  CHECK(view.camera.dump() ==
        R"({"sensor":{"preset":"uncooled_640"},"camera":{"width_px":640,"height_px":512,"fx_px":757.7}})");
  CHECK(view.remarks == std::vector<std::string>{"Model = \"XT9\" of \"DJI\" is no camera of assets/sensors; "
                                                 "uncooled_640, whose noise is an estimate"});
  const PhotoView lens = view_of(without(with(mavic(), "Model", "XT9"), {"Exif:FocalLengthIn35mmFilm"}));
  CHECK(lens.camera["camera"]["lens_mm"] == 9.1);
}

TEST_CASE("Visible photos and pictures of no camera are refused") {
  const auto fault_of = [](const PhotoTags& tags) {
    return message_of<DataError>([&] { (void)view_of(tags); });
  };
  CHECK(fault_of(with(mavic(), "drone-dji:ImageSource", "WideCamera")) ==
        "drone-dji:ImageSource = \"WideCamera\"; expected InfraredCamera, a thermal photo");
  PhotoTags large = without(mavic(), {"drone-dji:ImageSource"});
  large.size = {.width_px = 4000, .height_px = 3000};
  CHECK(fault_of(large) ==
        "size of the picture = 4000 x 3000 px; expected at most 1280 px wide, a thermal photo");
  CHECK(fault_of({.size = {.width_px = 640, .height_px = 512}, .texts = {{"oiio:ColorSpace", "sRGB"}}}) ==
        "no tags of a camera; expected EXIF's Model, or XMP of a drone (drone-dji, FLIR, Camera)");
}

TEST_CASE("Junk in tags counts as missing") {
  PhotoTags tags = mavic();
  for (auto& [name, text] : tags.texts)
    if (name != "Model" && name != "drone-dji:ImageSource")
      text = GENERATE("", "nan", "1e999", "-", "::::::::::::::::", "9/");
  const PhotoView view = view_of(tags);
  CHECK_FALSE(view.altitude_m);
  CHECK_FALSE(view.look_angle_deg);
  CHECK(view.weather.empty());
  CHECK(view.camera.dump() == R"({"sensor":{"preset":"dji_mavic_3t"}})");
}

TEST_CASE("Views of photos are read as they were written") {
  const TestFolder folder;
  const Path file =
      folder.file("views.csv", "# of photos\n" + views_text({{{60.1, 45}, 2}, {{120, 89.9}, 1}}));
  const std::vector<View> views = read_views(file, kAssets.schema("config")["$defs"]["flight"]["properties"]);
  REQUIRE(views.size() == 2);
  CHECK(views[0].values.at("altitude_m") == 60.1);
  CHECK(views[0].values.at("look_angle_deg") == 45);
  CHECK(views[0].weight == 2);
  CHECK(views[1].values.at("look_angle_deg") == 89.9);
}

}  // namespace photo_view_test
