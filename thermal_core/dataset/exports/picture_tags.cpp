#include "dataset/exports/picture_tags.h"

#include <chrono>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "base/error.h"
#include "base/relative_name.h"
#include "io/assets.h"
#include "io/config/spectra.h"

namespace thermal {
namespace {

constexpr double kMostAwayM = 100'000;

/// A section of a config with a clip's changes.
Json section_of(const Json& document, const std::string& clip, const char* name) {
  Json section = document.value(name, Json::object());
  for (const Json& entry : document.value("clips", Json::array()))
    if (entry.value("id", "") == clip && entry.contains(name)) section.merge_patch(entry[name]);
  return section;
}

std::optional<double> number_of(const Json& section, const char* key) {
  if (!section.is_object() || !section.contains(key) || !section[key].is_number()) return std::nullopt;
  return section[key].get<double>();
}

/// Empty if this machine does not have that response.
std::optional<SpectralResponse> response_of(const Json& sensor) {
  const auto name = RelativeName::part_of(sensor.value("response", std::string()));
  if (!name) return std::nullopt;
  try {
    return read_response(Assets::find().folder("responses") / (name->text() + ".csv"));
  } catch (const Error&) {
    return std::nullopt;
  }
}

struct Band {
  double centre_um;
  double width_um;
};

/// Between the outermost wavelengths at which the response is half its maximum.
Band half_maximum(const SpectralResponse& response) {
  const auto samples = response.samples();
  double first_um = samples.front().wavelength_um;
  double last_um = samples.back().wavelength_um;
  const auto crossing_um = [](const auto& low, const auto& high) {
    return low.wavelength_um +
           (0.5 - low.response) / (high.response - low.response) * (high.wavelength_um - low.wavelength_um);
  };
  for (std::size_t k = samples.size() - 1; k > 0; --k)
    if (samples[k - 1].response < 0.5 && samples[k].response >= 0.5)
      first_um = crossing_um(samples[k - 1], samples[k]);
  for (std::size_t k = 0; k + 1 < samples.size(); ++k)
    if (samples[k].response >= 0.5 && samples[k + 1].response < 0.5)
      last_um = crossing_um(samples[k], samples[k + 1]);
  return {.centre_um = (first_um + last_um) / 2, .width_um = last_um - first_um};
}

std::string sequence(const char* tag, const std::string& value) {
  return fmt::format("<Camera:{0}><rdf:Seq><rdf:li>{1}</rdf:li></rdf:Seq></Camera:{0}>", tag, value);
}

std::string xmp_of(const TaggedCamera& camera, const std::optional<CameraAttitude>& attitude) {
  constexpr double kNanometres = 1000;
  std::string attributes;
  std::string elements = sequence("BandName", "LWIR");
  if (attitude)
    // Positions are exact; without an accuracy, OpenDroneMap assumes 10 m.
    attributes = fmt::format(
        " Camera:Yaw=\"{:.6f}\" Camera:Pitch=\"{:.6f}\" Camera:Roll=\"{:.6f}\""
        " Camera:GPSXYAccuracy=\"0.01\" Camera:GPSZAccuracy=\"0.01\"",
        attitude->yaw_deg, attitude->pitch_deg, attitude->roll_deg);
  if (camera.response) {
    const Band band = half_maximum(*camera.response);
    elements += sequence("CentralWavelength", fmt::format("{:.0f}", kNanometres * band.centre_um));
    elements += sequence("WavelengthFWHM", fmt::format("{:.0f}", kNanometres * band.width_um));
  }
  return fmt::format(
      "<?xpacket begin=\"\xEF\xBB\xBF\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>"
      "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">"
      "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">"
      "<rdf:Description rdf:about=\"\" xmlns:Camera=\"http://pix4d.com/camera/1.0/\"{}>{}</rdf:Description>"
      "</rdf:RDF></x:xmpmeta><?xpacket end=\"r\"?>",
      attributes, elements);
}

/// Scale and unit of a band, in GDAL's format.
std::string gdal_metadata_of(TiffType type, double kelvin_per_count) {
  std::string items;
  if (type == TiffType::uint16)
    items = fmt::format(
        "<Item name=\"OFFSET\" sample=\"0\" role=\"offset\">0</Item>"
        "<Item name=\"SCALE\" sample=\"0\" role=\"scale\">{}</Item>",
        kelvin_per_count);
  return fmt::format(
      "<GDALMetadata>{}<Item name=\"UNITTYPE\" sample=\"0\" role=\"unittype\">K</Item></GDALMetadata>",
      items);
}

/// Local solar time of a frame, to a millisecond: EXIF's date and the digits after the second. Times past midnight are
/// on the following date; a clip is shorter than two days.
void set_time(const TaggedCamera& camera, double time_s, TiffTags& tags) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;
  if (std::sscanf(camera.date.c_str(), "%4d-%2d-%2d", &year, &month, &day) != 3 ||
      std::sscanf(camera.time.c_str(), "%2d:%2d", &hour, &minute) != 2)
    return;
  using namespace std::chrono;
  const auto start = sys_days{std::chrono::year{year} / month / day} + hours{hour} + minutes{minute};
  const auto moment = start + milliseconds{std::llround(time_s * 1000)};
  const auto midnight = floor<days>(moment);
  const year_month_day date{midnight};
  const hh_mm_ss clock{floor<milliseconds>(moment - midnight)};
  tags.taken_at = fmt::format("{:04}:{:02}:{:02} {:02}:{:02}:{:02}", static_cast<int>(date.year()),
                              static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                              clock.hours().count(), clock.minutes().count(), clock.seconds().count());
  tags.subsecond = fmt::format("{:03}", clock.subseconds().count());
}

void check_near(const LocalVector& point_m) {
  for (const double coordinate_m : point_m)
    if (!(std::abs(coordinate_m) <= kMostAwayM))
      throw DataError(fault("camera_to_world: position", fmt::format("{:g}", coordinate_m), "m",
                            fmt::format("-{0} to {0} m", kMostAwayM)));
}

CameraAttitude attitude_at(const std::array<double, 16>& pose, const Georeference& georeference,
                           const GeoPosition& where) {
  std::array<LocalVector, 3> axes{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    axes[axis] = georeference.direction_at(where, {pose[axis], pose[4 + axis], pose[8 + axis]});
  return attitude_of(axes[0], axes[1], axes[2]);
}

}  // namespace

TaggedCamera tagged_camera(const Json& document, const std::string& clip, const Json& intrinsics) {
  const Json sensor = section_of(document, clip, "sensor");
  const Json weather = section_of(document, clip, "weather");
  return {.model = sensor.value("preset", sensor.value("model", std::string())),
          .fx_px = number_of(intrinsics, "fx_px"),
          .pixel_pitch_um = number_of(section_of(document, clip, "camera"), "pixel_pitch_um"),
          .f_number = number_of(sensor.value("optics", Json::object()), "f_number"),
          .response = response_of(sensor),
          .date = weather.value("date", std::string()),
          .time = weather.value("time", std::string())};
}

TiffTags picture_tags(const TaggedCamera& camera, const FramePose& pose, const Georeference& georeference,
                      TiffType type, double kelvin_per_count) {
  TiffTags tags = {
      .description = type == TiffType::float32
                         ? "Synthetic thermal image: apparent temperature in kelvin"
                         : fmt::format("Synthetic thermal image: apparent temperature in kelvin = value * {}",
                                       kelvin_per_count),
      .make = "Veldt",
      .model = camera.model,
      .software = "Veldt",
      .gdal_metadata = gdal_metadata_of(type, kelvin_per_count),
      .f_number = camera.f_number};
  if (camera.fx_px && camera.pixel_pitch_um) {
    tags.focal_length_mm = *camera.fx_px * *camera.pixel_pitch_um / 1000;
    tags.pixels_per_cm = 1e4 / *camera.pixel_pitch_um;
  }
  set_time(camera, pose.time_s, tags);
  std::optional<CameraAttitude> attitude;
  if (pose.camera_to_world) {
    const std::array<double, 16>& matrix = *pose.camera_to_world;
    const LocalVector point_m = {matrix[3], matrix[7], matrix[11]};
    check_near(point_m);
    tags.position = georeference.position_of(point_m);
    attitude = attitude_at(matrix, georeference, *tags.position);
  }
  tags.xmp = xmp_of(camera, attitude);
  return tags;
}

}  // namespace thermal
