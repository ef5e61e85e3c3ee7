#include "io/config/photo_view.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/config/sensor.h"

namespace thermal {
namespace {

constexpr const char* kUnknownCamera = "uncooled_640";
constexpr double kFilmDiagonalMm = 43.2666;  // of 36 mm x 24 mm, by which equivalent focal lengths are stated
constexpr int kWidestDetectorPx = 1280;
constexpr double kSameLens = 0.03;  // makers round focal lengths, and lenses differ by as much

/// To a number of steps a unit; divided, so that the result prints with as few digits.
double in_steps(double value, double steps_a_unit) {
  return std::round(value * steps_a_unit) / steps_a_unit + 0.0;
}

/// "+60.10", "61200/1000" or "1.5".
std::optional<double> tag_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const std::size_t slash = text.find('/');
  const std::optional<double> above = number_in<double>(text.substr(0, slash));
  if (slash == std::string_view::npos || !above) return above;
  const std::optional<double> below = number_in<double>(text.substr(slash + 1));
  return below && *below != 0 ? std::optional(*above / *below) : std::nullopt;
}

/// What one photo says, tag by tag.
class TagReader {
 public:
  TagReader(const PhotoTags& tags, std::vector<std::string>& remarks) : tags_(tags), remarks_(remarks) {}

  [[nodiscard]] std::string text(std::string_view name) const {
    const auto found = tags_.texts.find(name);
    return found == tags_.texts.end() ? "" : found->second;
  }

  /// Nothing if it is missing or no number.
  [[nodiscard]] std::optional<double> number(std::string_view name) const { return tag_number(text(name)); }

  /// The first of these tags that is a number; what is out of range is remarked and passed over.
  [[nodiscard]] std::optional<double> first_within(std::initializer_list<std::string_view> names,
                                                   double least, double most, std::string_view unit,
                                                   std::string_view meaning) const {
    for (const std::string_view name : names) {
      const std::optional<double> found = number(name);
      if (found && *found >= least && *found <= most) return found;
      if (found)
        remarks_.push_back(
            fault(name, text(name), unit, fmt::format("{} to {} {}, {}", least, most, unit, meaning)));
    }
    return std::nullopt;
  }

  /// Several numbers of one tag, such as degrees, minutes and seconds.
  [[nodiscard]] std::array<double, 3> triple(std::string_view name) const {
    std::array<double, 3> numbers = {kNone, kNone, kNone};
    const std::string all = text(name);
    std::size_t k = 0;
    for (const std::string_view part : split(all, ' '))
      if (k < numbers.size()) numbers.at(k++) = tag_number(part).value_or(kNone);
    return numbers;
  }

  void remark(std::string what) const { remarks_.push_back(std::move(what)); }

 private:
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const PhotoTags& tags_;
  std::vector<std::string>& remarks_;
};

/// EXIF has degrees, minutes and seconds, and a letter for the sign.
std::optional<double> place_deg(const TagReader& tags, const std::string& axis, std::string_view negative,
                                double most_deg) {
  const std::array<double, 3> parts = tags.triple("GPS:" + axis);
  const double deg = parts[0] + parts[1] / 60 + parts[2] / 3600;
  if (!(deg >= 0 && deg <= most_deg))
    return tags.first_within({"drone-dji:Gps" + axis}, -most_deg, most_deg, "deg", "on Earth");
  return tags.text("GPS:" + axis + "Ref") == negative ? -deg : deg;
}

std::optional<std::chrono::sys_days> photo_day(std::string_view text) {
  if (text.size() < 10) return std::nullopt;
  const auto year = number_in<int>(text.substr(0, 4));
  const auto month = number_in<unsigned>(text.substr(5, 2));
  const auto day = number_in<unsigned>(text.substr(8, 2));
  if (!year || *year < 1900 || !month || !day) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(*year), std::chrono::month(*month),
                                         std::chrono::day(*day)};
  return date.ok() ? std::optional<std::chrono::sys_days>(date) : std::nullopt;
}

void write_moment(std::chrono::sys_seconds moment, Json& weather) {
  using namespace std::chrono;
  const auto midnight = floor<days>(moment);
  const year_month_day date = midnight;
  const hh_mm_ss clock(moment - midnight);
  weather["date"] =
      fmt::format("{:04}-{:02}-{:02}", int(date.year()), unsigned(date.month()), unsigned(date.day()));
  weather["time"] = fmt::format("{:02}:{:02}", clock.hours().count(), clock.minutes().count());
}

/// Mean solar time: that of satellites and the longitude, or else the camera's clock.
void read_moment(const TagReader& tags, std::optional<double> longitude_deg, Json& weather) {
  using namespace std::chrono;
  const std::string stamp = tags.text("GPS:DateStamp");
  const std::array<double, 3> utc = tags.triple("GPS:TimeStamp");
  const double utc_s = 3600 * utc[0] + 60 * utc[1] + utc[2];
  const std::optional<sys_days> utc_day = photo_day(stamp);
  if (utc_day && utc_s >= 0 && utc_s <= 86400 && longitude_deg)
    return write_moment(*utc_day + seconds(std::lround(utc_s + *longitude_deg * 240)), weather);
  const std::string clock = tags.text("Exif:DateTimeOriginal");
  const std::optional<sys_days> day = photo_day(clock);
  const auto hour = clock.size() < 16 ? std::nullopt : number_in<int>(std::string_view(clock).substr(11, 2));
  const auto minute =
      clock.size() < 16 ? std::nullopt : number_in<int>(std::string_view(clock).substr(14, 2));
  if (!day || !hour || !minute || *hour < 0 || *hour > 23 || *minute < 0 || *minute > 59)
    return tags.remark(
        "no GPS:TimeStamp, no Exif:DateTimeOriginal; weather.date and weather.time are left out");
  write_moment(*day + hours(*hour) + minutes(*minute), weather);
  tags.remark("no GPS:TimeStamp with a place; weather.time is the camera's clock, not solar time");
}

Json read_weather_of(const TagReader& tags, std::optional<double> altitude_m) {
  constexpr double kHighestM = 9000;
  Json weather = Json::object();
  const std::optional<double> latitude_deg = place_deg(tags, "Latitude", "S", 90);
  read_moment(tags, place_deg(tags, "Longitude", "W", 180), weather);
  if (latitude_deg) weather["latitude_deg"] = in_steps(*latitude_deg, 100);
  const std::optional<double> sea_m = tags.number("GPS:Altitude");
  if (sea_m && altitude_m) {
    const double ground_m = (tags.text("GPS:AltitudeRef") == "1" ? -*sea_m : *sea_m) - *altitude_m;
    if (ground_m >= -500 && ground_m <= kHighestM) weather["elevation_m"] = in_steps(ground_m, 1);
  }
  return weather;
}

/// DJI's gimbals are at -90 deg when they look straight down, Pix4D's cameras at 0; gimbals overshoot by a degree.
std::optional<double> read_look_angle(const TagReader& tags) {
  constexpr double kOvershootDeg = 1.5;
  std::optional<double> look_deg =
      tags.first_within({"drone-dji:GimbalPitchDegree"}, -90 - kOvershootDeg, -1, "deg", "below the horizon");
  if (look_deg) {
    look_deg = -*look_deg;
  } else if (const auto pitch_deg = tags.first_within({"Camera:Pitch"}, -kOvershootDeg, 89, "deg",
                                                      "from straight down, 0, to the horizon, 90")) {
    look_deg = 90 - *pitch_deg;
    tags.remark(
        "no drone-dji:GimbalPitchDegree; Camera:Pitch is taken as Pix4D defines it, 0 being straight down");
  }
  if (!look_deg) {
    tags.remark(
        "no drone-dji:GimbalPitchDegree or Camera:Pitch; expected one of them for flight.look_angle_deg");
    return std::nullopt;
  }
  return in_steps(std::min(*look_deg, 90.0), 10);
}

std::optional<double> read_altitude(const TagReader& tags) {
  const std::optional<double> altitude_m = tags.first_within(
      {"drone-dji:RelativeAltitude", "FLIR:MAVRelativeAltitude", "Camera:AboveGroundAltitude"}, 1, 5000, "m",
      "in flight");
  if (altitude_m) return in_steps(*altitude_m, 10);
  tags.remark(
      "no drone-dji:RelativeAltitude, FLIR:MAVRelativeAltitude or Camera:AboveGroundAltitude; expected one "
      "of them for flight.altitude_m");
  return std::nullopt;
}

/// North is 0 and clockwise for aircraft; +x is east.
std::optional<double> read_heading(const TagReader& tags) {
  const std::optional<double> yaw_deg = tags.first_within(
      {"drone-dji:FlightYawDegree", "FLIR:MAVYaw", "Camera:Yaw"}, -360, 360, "deg", "from north");
  if (!yaw_deg) return std::nullopt;
  return in_steps(std::remainder(90 - *yaw_deg, 360.0), 10);
}

double focal_px(const CameraPreset& preset) { return preset.focal_length_m / (preset.pixel_pitch_um * 1e-6); }

/// Of those whose model this one names, such as "FLIR Vue Pro R 640 13mm", the preset whose lens is nearest to
/// `focal_mm`; null if there is none.
const CameraPreset* preset_of(const std::string& model, std::optional<double> focal_mm,
                              const std::vector<CameraPreset>& presets) {
  const CameraPreset* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const CameraPreset& preset : presets) {
    const bool known = std::ranges::any_of(preset.models, [&](const std::string& one) {
      return lower_case(model).find(lower_case(one)) != std::string::npos;
    });
    if (!known) continue;
    const double off = focal_mm ? std::abs(std::log(*focal_mm / (1000 * preset.focal_length_m))) : 0;
    if (best == nullptr || off < least) {
      best = &preset;
      least = off;
    }
  }
  return best;
}

/// The lens of a camera that no preset knows.
void add_unknown_lens(const TagReader& tags, const PictureSize& size, std::optional<double> focal_mm,
                      Json& camera) {
  if (const auto film_mm = tags.first_within({"Exif:FocalLengthIn35mmFilm"}, 1, 10000, "mm", "of a lens")) {
    camera["fx_px"] = in_steps(*film_mm * std::hypot(size.width_px, size.height_px) / kFilmDiagonalMm, 10);
  } else if (focal_mm) {
    camera["lens_mm"] = in_steps(*focal_mm, 100);
    tags.remark("no Exif:FocalLengthIn35mmFilm; pixels are taken to be 12 um wide");
  } else {
    tags.remark("no Exif:FocalLengthIn35mmFilm or Exif:FocalLength; the lens is that of the preset");
  }
}

Json unknown_camera(const TagReader& tags, const PictureSize& size, std::optional<double> focal_mm) {
  Json camera = {{"width_px", size.width_px}, {"height_px", size.height_px}};
  add_unknown_lens(tags, size, focal_mm, camera);
  tags.remark(
      fmt::format("Model = \"{}\" of \"{}\" is no camera of assets/sensors; {}, whose noise is an estimate",
                  tags.text("Model"), tags.text("Make"), kUnknownCamera));
  return {{"sensor", {{"preset", kUnknownCamera}}}, {"camera", std::move(camera)}};
}

Json known_camera(const TagReader& tags, const PictureSize& size, std::optional<double> focal_mm,
                  const CameraPreset& preset) {
  Json camera = Json::object();
  double length_mm = 1000 * preset.focal_length_m;
  if (!focal_mm)
    tags.remark("no Exif:FocalLength; the lens is that of the preset " + preset.name);
  else if (std::abs(std::log(*focal_mm / length_mm)) > kSameLens)
    camera["lens_mm"] = in_steps(length_mm = *focal_mm, 100);
  if (size.width_px != preset.size.width_px || size.height_px != preset.size.height_px) {
    const double enlarged = 1.0 * size.width_px / preset.size.width_px;
    camera.erase("lens_mm");
    camera["width_px"] = size.width_px;
    camera["height_px"] = size.height_px;
    camera["fx_px"] = in_steps(focal_px(preset) * length_mm / (1000 * preset.focal_length_m) * enlarged, 10);
    tags.remark(fmt::format("{} x {} px, of a detector of {} x {} px; its whole width is taken to be shown",
                            size.width_px, size.height_px, preset.size.width_px, preset.size.height_px));
  }
  Json found = {{"sensor", {{"preset", preset.name}}}};
  if (!camera.empty()) found["camera"] = std::move(camera);
  return found;
}

/// DJI says which of a drone's cameras took a photo. Thermal pictures are enlarged twice at most.
void check_is_thermal(const TagReader& tags, const PictureSize& size, const CameraPreset* preset) {
  const std::string source = tags.text("drone-dji:ImageSource");
  if (!source.empty() && lower_case(source).find("infrared") == std::string::npos)
    throw DataError(
        fault("drone-dji:ImageSource", "\"" + source + "\"", "", "InfraredCamera, a thermal photo"));
  const int most_px = 2 * (preset == nullptr ? kWidestDetectorPx : preset->size.width_px);
  if (size.width_px > most_px)
    throw DataError(fault("size of the picture", fmt::format("{} x {}", size.width_px, size.height_px), "px",
                          fmt::format("at most {} px wide, a thermal photo", most_px)));
}

}  // namespace

std::vector<CameraPreset> photographed_presets(const Json& schema, const Assets& assets) {
  std::vector<CameraPreset> presets;
  for (const auto& [name, preset] : sensor_presets(schema, assets)) {
    if (!preset.contains("models")) continue;
    const Json& camera = preset["camera"];
    presets.push_back({.name = name,
                       .models = preset["models"],
                       .size = {.width_px = camera["width_px"], .height_px = camera["height_px"]},
                       .focal_length_m = camera["focal_length_m"],
                       .pixel_pitch_um = camera["pixel_pitch_um"]});
  }
  return presets;
}

PhotoView read_photo_view(const PhotoTags& tags, const std::vector<CameraPreset>& presets) {
  PhotoView view;
  const TagReader reader(tags, view.remarks);
  const bool is_of_drone = std::ranges::any_of(tags.texts, [](const auto& tag) {
    return tag.first.starts_with("drone-dji:") || tag.first.starts_with("FLIR:") ||
           tag.first.starts_with("Camera:");
  });
  if (reader.text("Model").empty() && !is_of_drone)
    throw DataError(
        "no tags of a camera; expected EXIF's Model, or XMP of a drone (drone-dji, FLIR, Camera)");
  const std::optional<double> focal_mm =
      reader.first_within({"Exif:FocalLength"}, 1, 1000, "mm", "of a lens");
  const CameraPreset* preset = preset_of(reader.text("Model"), focal_mm, presets);
  check_is_thermal(reader, tags.size, preset);
  view.altitude_m = read_altitude(reader);
  view.look_angle_deg = read_look_angle(reader);
  view.heading_deg = read_heading(reader);
  view.weather = read_weather_of(reader, view.altitude_m);
  view.camera = preset == nullptr ? unknown_camera(reader, tags.size, focal_mm)
                                  : known_camera(reader, tags.size, focal_mm, *preset);
  return view;
}

}  // namespace thermal
