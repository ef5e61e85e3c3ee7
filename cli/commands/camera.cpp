#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "cli/command.h"
#include "cli/output.h"
#include "io/assets.h"
#include "io/config/photo_view.h"
#include "io/config/views_file.h"
#include "io/image/pictures.h"

namespace veldt {
namespace {

struct CameraArguments {
  std::vector<std::string> photos;
  std::string views;
};

/// The camera of several photos, and the frequency of each of their views.
struct Views {
  std::map<std::string, std::pair<thermal::Json, int>> cameras;  ///< sections and photos, by their text
  std::map<std::pair<double, double>, int> counts;
  int rejected = 0;
};

void add_pictures(const thermal::Path& folder, std::vector<thermal::Path>& photos) {
  const auto begin = static_cast<std::ptrdiff_t>(photos.size());
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (thermal::is_grey_picture(entry.path())) photos.push_back(entry.path());
  std::sort(photos.begin() + begin, photos.end());
}

/// The given files, and the pictures in given folders.
std::vector<thermal::Path> photos_of(const CameraArguments& options) {
  std::vector<thermal::Path> photos;
  for (const std::string& name : options.photos) {
    if (std::filesystem::is_directory(name))
      add_pictures(name, photos);
    else
      photos.emplace_back(name);
  }
  if (photos.empty())
    throw thermal::ConfigError(thermal::fault("PHOTO", fmt::format("{}", fmt::join(options.photos, ", ")), "",
                                              "a photo, or a folder with .jpg, .png or .tif files"));
  if (photos.size() > 1 && options.views.empty())
    throw thermal::ConfigError(fmt::format(
        "{} photos; expected one, or --views FILE.csv, which takes the views of many", photos.size()));
  return photos;
}

class PhotoReader {
 public:
  explicit PhotoReader(const thermal::Assets& assets)
      : presets_(thermal::photographed_presets(assets.schema("config"), assets)) {}

  /// DataError and IoError with the file.
  [[nodiscard]] thermal::PhotoView read(const thermal::Path& file) const {
    const thermal::PhotoTags tags = thermal::read_photo_tags(file);
    try {
      return thermal::read_photo_view(tags, presets_);
    } catch (const thermal::DataError& error) {
      throw thermal::DataError(file.string() + ": " + error.what());
    }
  }

 private:
  std::vector<thermal::CameraPreset> presets_;
};

void print_fragment(const thermal::PhotoView& view) {
  thermal::Json fragment = view.camera;
  if (!view.weather.empty()) fragment["weather"] = view.weather;
  thermal::Json flight = thermal::Json::object();
  if (view.altitude_m) flight["altitude_m"] = *view.altitude_m;
  if (view.look_angle_deg) flight["look_angle_deg"] = *view.look_angle_deg;
  if (view.heading_deg) flight["heading_deg"] = *view.heading_deg;
  if (!flight.empty()) fragment["flight"] = std::move(flight);
  print_json(fragment);
}

int run_one(const PhotoReader& reader, const thermal::Path& photo, const CommonOptions& common) {
  thermal::PhotoView view = reader.read(photo);
  if (!view.altitude_m) view.remarks.emplace_back("flight.altitude_m is left out, and 61 m by default");
  if (!view.look_angle_deg)
    view.remarks.emplace_back("flight.look_angle_deg is left out, and 90 deg by default");
  if (!common.quiet)
    for (const std::string& remark : view.remarks) print_error("{}: {}\n", photo.string(), remark);
  print_fragment(view);
  return kDone;
}

void count_view(const PhotoReader& reader, const thermal::Path& photo, Views& views) {
  const thermal::PhotoView view = reader.read(photo);
  if (!view.altitude_m || !view.look_angle_deg)
    throw thermal::DataError(photo.string() + ": " + view.remarks.front());
  ++views.counts[{*view.altitude_m, *view.look_angle_deg}];
  auto& [sections, count] = views.cameras[view.camera.dump()];
  sections = view.camera;
  ++count;
}

void check_one_camera(const Views& views) {
  if (views.cameras.empty())
    throw thermal::DataError("no thermal photo with height and gimbal angle; expected at least one");
  if (views.cameras.size() == 1) return;
  std::vector<std::string> found;
  for (const auto& [text, camera] : views.cameras)
    found.push_back(fmt::format("{} ({})", text, camera.second));
  throw thermal::DataError(fmt::format("photos of {} cameras: {}; expected those of one",
                                       views.cameras.size(), thermal::list_names(found)));
}

void check_views_file(const thermal::Path& file) {
  const auto refuse = [&file](const char* rule) {
    throw thermal::ConfigError(thermal::fault("--views", file.string(), "", rule));
  };
  if (std::filesystem::exists(file)) refuse("a file that does not exist yet");
  if (file.has_parent_path() && !std::filesystem::is_directory(file.parent_path()))
    refuse("a file in an existing folder");
}

int run_many(const PhotoReader& reader, const std::vector<thermal::Path>& photos, const thermal::Path& file) {
  check_views_file(file);
  Views views;
  for (const thermal::Path& photo : photos) {
    try {
      count_view(reader, photo, views);
    } catch (const thermal::Error& error) {
      print_error("{}\n", std::string(error.what()));
      ++views.rejected;
    }
  }
  check_one_camera(views);
  const std::size_t used = photos.size() - static_cast<std::size_t>(views.rejected);
  thermal::write_file_atomically(
      file,
      fmt::format("# Heights above take-off and look angles of {} photos; weight: photos of a view.\n{}",
                  used, thermal::views_text(views.counts)));
  thermal::Json fragment = views.cameras.begin()->second.first;
  fragment["flight"] = {{"views", {{"file", file.string()}}}};
  print_json(fragment);
  return views.rejected == 0 ? kDone : kSomeRejected;
}

int run_camera(const CameraArguments& options, const CommonOptions& common) {
  const std::vector<thermal::Path> photos = photos_of(options);
  const PhotoReader reader(thermal::Assets::find());
  return options.views.empty() ? run_one(reader, photos.front(), common)
                               : run_many(reader, photos, options.views);
}

}  // namespace

void add_camera(Parser& parser) {
  Command command = parser.add_command(
      "camera", "Camera, height and angle of a drone's thermal photos, as parts of a config");
  command.footer("Example: veldt camera DJI_0012_T.JPG");
  auto options = std::make_shared<CameraArguments>();
  command.add_option("photos", options->photos, "Thermal photos with EXIF and XMP, or folders of them")
      .type_name("PHOTO")
      .required();
  command
      .add_option(
          "--views", options->views,
          "Write height, look angle and weight of all photos, for a flight's views; never overwrites a file")
      .type_name("CSV");
  command.runs([options](const CommonOptions& common) { return run_camera(*options, common); });
}

}  // namespace veldt
