#include <array>
#include <map>
#include <optional>

#include <sys/inotify.h>
#include <unistd.h>

#include "base/relative_name.h"
#include "base/version.h"
#include "dataset/clip/record.h"
#include "dataset/clip_files.h"
#include "dataset/dataset_file.h"
#include "dataset/exports/export.h"
#include "dataset/inspect/validate.h"
#include "dataset/run/merge.h"
#include "fuzz/targets.h"
#include "io/json/file.h"
#include "io/label_files/coco.h"
#include "io/system/sha256.h"
#include "support/assets.h"
#if VELDT_REPORT
#include "dataset/reports/report.h"
#endif
#if VELDT_VIDEO
#include "dataset/view/view.h"
#endif

namespace {

using thermal::Json;
using thermal::Path;

/// A folder for a dataset, beside one that no dataset may lead to. inotify reports whether anything there was touched.
class Place {
 public:
  Place() : descriptor_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    const Path secret = folder_ / "secret";
    std::filesystem::create_directories(secret / "clips" / "one" / "ir8");
    for (const char* file : {"key.png", "dataset.json", "annotations.json", "clips/one/clip.json",
                             "clips/one/labels.json", "clips/one/ir8/000000.png"})
      (void)folder_.file(std::string("secret/") + file, "{}");
    for (const Path& part :
         {secret, secret / "clips", secret / "clips" / "one", secret / "clips" / "one" / "ir8"})
      demand(::inotify_add_watch(descriptor_, part.c_str(), IN_ALL_EVENTS) >= 0, "a folder can be watched");
  }
  ~Place() { ::close(descriptor_); }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

  /// Removes what the last input made.
  void clear() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      if (entry.path().filename() != "secret") std::filesystem::remove_all(entry.path());
  }
  [[nodiscard]] Path at(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] bool is_untouched() const {
    std::array<char, 4096> events{};
    return ::read(descriptor_, events.data(), events.size()) < 0;
  }

 private:
  TestFolder folder_;
  int descriptor_;
};

using Contents = std::map<std::string, std::string>;

/// "@sum FILE" becomes the SHA-256 of a file written before, without which no check would let an input pass.
void fill_in(Json& value, const Contents& written) {
  constexpr std::string_view kSum = "@sum ";
  if (value.is_structured()) {
    for (Json& part : value) fill_in(part, written);
  } else if (value == "@version") {
    value = thermal::kVersion;
  } else if (value.is_string() && value.get_ref<const std::string&>().starts_with(kSum)) {
    const auto found = written.find(value.get<std::string>().substr(kSum.size()));
    if (found != written.end()) value = thermal::sha256_of(found->second);
  }
}

/// A string is text, an array of numbers is bytes, and anything else is a JSON document.
std::string content_of(Json value, const Contents& written) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_array()) {
    std::string bytes;
    for (const Json& byte : value) bytes += static_cast<char>(byte.is_number_integer() ? byte.get<int>() : 0);
    return bytes;
  }
  fill_in(value, written);
  return value.dump(1, ' ', false, Json::error_handler_t::replace);
}

/// Where an entry of the input is made: below the dataset's folder.
std::optional<Path> place_of(const std::string& name, const Path& root) {
  const auto inside = thermal::RelativeName::of(name);
  if (!inside) return std::nullopt;
  const Path path = root / inside->text();
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error || std::filesystem::exists(std::filesystem::symlink_status(path, error))) return std::nullopt;
  return path;
}

void write_files(const Json& files, const Path& root) {
  Contents written;
  for (const auto& [name, value] : files.items()) {
    const std::optional<Path> path = place_of(name, root);
    if (!path) continue;
    written[name] = content_of(value, written);
    std::ofstream(*path, std::ios::binary) << written[name];
  }
}

/// Last, so that nothing is written through them.
void make_links(const Json& links, const Path& root) {
  for (const auto& [name, target] : links.items()) {
    const std::optional<Path> path = place_of(name, root);
    std::error_code ignored;
    if (path && target.is_string())
      std::filesystem::create_symlink(target.get<std::string>(), *path, ignored);
  }
}

/// What the Python package reads of a dataset.
void read_clips(const Path& set) {
  const Json dataset = thermal::read_dataset_file(set);
  for (const Json& clip : dataset.at("clips")) {
    const Path folder = thermal::Layout{set}.clip(clip["id"]);
    tolerate([&] { (void)thermal::read_clip_record(folder / "clip.json"); });
    tolerate([&] { thermal::for_clip_frames(folder, [](int, const Json&) {}); });
    tolerate([&] {
      thermal::for_clip_labels(folder, [](int, const std::string&, const std::string& text) {
        demand(Json::accept(text), "an annotation is JSON");
      });
    });
  }
}

void use(const Place& place) {
  const Path set = place.at("set");
  tolerate([&set] { read_clips(set); });
  tolerate([&set] { (void)thermal::read_coco_head(thermal::Layout{set}.annotations_json()); });
  tolerate([&set] { (void)thermal::validate_dataset(set); });
  tolerate([&] { thermal::merge({.sources = {set}, .out = place.at("merged")}, {}); });
  for (const auto format : {thermal::ExportFormat::coco, thermal::ExportFormat::yolo,
                            thermal::ExportFormat::mot, thermal::ExportFormat::webdataset})
    tolerate([&] {
      thermal::ExportOptions options;
      options.source = set;
      options.format = format;
      options.out = place.at(thermal::format_name(format));
      thermal::export_dataset(options, {});
    });
#if VELDT_REPORT
  tolerate([&] { thermal::write_report({.source = set, .out = place.at("page.html"), .assets = kAssets}); });
#endif
#if VELDT_VIDEO
  tolerate([&] {
    thermal::write_view({.source = set, .out = place.at("view"), .clips = {}, .assets = kAssets}, {});
  });
#endif
}

}  // namespace

void fuzz::dataset(Bytes bytes) {
  static const Place place;
  const Json input = Json::parse(bytes.begin(), bytes.end(), nullptr, false);
  if (!input.is_object()) return;
  place.clear();
  std::filesystem::create_directory(place.at("set"));
  if (input.contains("files") && input["files"].is_object()) write_files(input["files"], place.at("set"));
  if (input.contains("links") && input["links"].is_object()) make_links(input["links"], place.at("set"));
  demand(place.is_untouched(), "the input itself stays inside");
  use(place);
  demand(place.is_untouched(), "nothing outside of a dataset is opened");
}
