#include "dataset/inspect/inspection.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/exr/planes.h"
#include "io/json/camera.h"
#include "io/manifest_file.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

PassesGroup only_group(const std::vector<Path>& passes) {
  std::vector<PassesGroup> groups = group_passes(passes);
  if (groups.size() == 1) return std::move(groups.front());
  std::vector<std::string> folders;
  for (const PassesGroup& group : groups) folders.push_back(group.folder.string());
  throw ConfigError(fault("passes", list_names(folders), "", "one folder of passes, or files in one"));
}

std::optional<Manifest> manifest_of(const PassesGroup& group, const InspectOptions& options) {
  if (options.for_starter) return std::nullopt;
  if (!options.manifest.empty()) return read_manifest(options.manifest, options.assets);
  const Path beside = group.folder / "manifest.json";
  if (!std::filesystem::exists(beside)) return std::nullopt;
  return read_manifest(beside, options.assets);
}

/// Named files override the manifest's list: inspection is for users who do not know the contents of their files.
FrameSequence sequence_to_inspect(const PassesGroup& group, const std::optional<Manifest>& manifest) {
  const bool says = manifest && (!manifest->frames.empty() || !manifest->sequence.empty());
  if (!says || !group.files.empty()) return frames_of(group);
  FrameSequence sequence = frames_of(group, *manifest, group.folder / "manifest.json", true);
  for (FrameSequence::Frame& frame : sequence.frames)
    frame.is_gap = !std::filesystem::exists(group.folder / frame.name.name);
  return sequence;
}

/// A path as the user would type it: without the folder if one is given.
Path file_in(const PassesGroup& group, const std::string& name) {
  return group.folder == "." ? Path(name) : group.folder / name;
}

Path first_file(const PassesGroup& group, const FrameSequence& sequence) {
  const auto first = std::find_if(sequence.frames.begin(), sequence.frames.end(),
                                  [](const FrameSequence::Frame& frame) { return !frame.is_gap; });
  if (first != sequence.frames.end()) return file_in(group, first->name.name);
  throw IoError(fmt::format("{} holds none of the {} files that its manifest lists", group.folder.string(),
                            sequence.frames.size()));
}

ExrLayout layout_of(const std::optional<Manifest>& manifest, const InspectOptions& options) {
  ExrLayout layout;
  if (manifest) {
    const CameraIntrinsics camera = passes_camera(*manifest);
    layout.layer = manifest->layer;
    layout.actor_layer = manifest->actor_layer;
    layout.mirror_layer = manifest->mirror_layer;
    layout.channels = manifest->channels;
    layout.width_px = camera.width_px;
    layout.height_px = camera.height_px;
    layout.pixel_aspect = camera.fy_px / camera.fx_px;
  }
  if (!options.layer.empty()) layout.layer = options.layer;
  layout.limits.pixels = options.limits.pixels;
  return layout;
}

/// A picture's kind and size in the form of EXR headers.
ExrHeader header_of_picture(const Path& file, const ReadLimits& limits) {
  const PictureSurvey picture = survey_picture(file, limits);
  ExrHeader header;
  header.width_px = picture.width_px;
  header.height_px = picture.height_px;
  return header;
}

void read_header(Inspection& inspection, const ReadLimits& limits) {
  if (is_index_picture(inspection.file)) {
    inspection.header = header_of_picture(inspection.file, limits);
    return;
  }
  inspection.header = read_exr_header(inspection.file, inspection.layout.limits);
  const ExrWindow whole = {
      .x_px = 0, .y_px = 0, .width_px = inspection.header.width_px, .height_px = inspection.header.height_px};
  if (inspection.header.data_window != whole) inspection.window = inspection.header.data_window;
}

/// The cryptomatte to read without an object index: one named as that of objects, if there is one.
std::string best_cryptomatte(const std::vector<Cryptomatte>& all, const std::string& layer) {
  const Cryptomatte* best = nullptr;
  for (const Cryptomatte& one : all) {
    const bool elsewhere = !layer.empty() && !one.name.starts_with(layer + ".");
    if (!one.fault.empty() || elsewhere) continue;
    if (best == nullptr || one.name.ends_with("Object")) best = &one;
  }
  return best == nullptr ? "" : best->name;
}

std::vector<std::string> index_layers(const ExrHeader& header) {
  std::set<std::string> layers;
  for (const ExrChannel& channel : header.channels)
    if (pass_kind_of(channel.pass) == PassKind::object_index) layers.insert(channel.layer);
  return {layers.begin(), layers.end()};
}

/// Decides which planes a conversion of EXR files would read, or why it is impossible.
class Choice {
 public:
  Choice(Inspection& inspection, const InspectOptions& options)
      : inspection_(inspection), options_(options), cryptomattes_(cryptomattes_in(inspection.header)) {}

  void make() {
    for (const Cryptomatte& one : cryptomattes_) {
      auto& faults = inspection_.cryptomatte_faults;
      if (!one.fault.empty()) faults.push_back(one.fault);
      if (!one.names_fault.empty())
        faults.push_back(fmt::format("cryptomatte {}: {}", one.name, one.names_fault));
    }
    choose();
    try {
      check_projection(inspection_.header, inspection_.layout);
    } catch (const DataError& error) {
      inspection_.obstacle = error.what();
    }
  }

  /// An index plane of sky alone has never been set.
  void reconsider() {
    const auto& objects = inspection_.survey.objects;
    const bool only_sky = objects.size() == 1 && objects.begin()->first == kSkyIndex;
    const std::string cryptomatte = best_cryptomatte(cryptomattes_, inspection_.layout.layer);
    if (only_sky && !inspection_.manifest && !cryptomatte.empty()) take_cryptomatte(cryptomatte);
  }

 private:
  void choose() {
    try {
      take_what_is_named();
    } catch (const DataError& error) {
      inspection_.obstacle = error.what();
      const ExrLayout& layout = inspection_.layout;
      if (!layout.channels.object_index.empty()) return;
      const std::vector<std::string> layers = index_layers(inspection_.header);
      if (layers.empty()) take_what_there_is();
      if (layers.size() > 1 && layout.layer.empty()) inspection_.layers = layers;
    }
  }

  void take_what_is_named() {
    const std::string wanted = inspection_.manifest ? inspection_.manifest->cryptomatte : "";
    if (wanted.empty()) {
      inspection_.planes = choose_planes(inspection_.header, inspection_.layout);
    } else {
      take_cryptomatte(choose_cryptomatte(cryptomattes_, wanted, inspection_.layout.layer).name);
    }
  }

  /// The other planes are in the same layer.
  void take_cryptomatte(const std::string& name) {
    inspection_.cryptomatte = name;
    const std::size_t dot = name.rfind('.');
    const std::string layer = dot == std::string::npos ? inspection_.layout.layer : name.substr(0, dot);
    const auto name_of = [](const ExrChannel* channel) {
      return channel == nullptr ? "" : channel->full_name();
    };
    inspection_.planes = {.objects = "",
                          .materials = name_of(inspection_.header.find_material_index(layer)),
                          .depth = name_of(inspection_.header.find_depth(layer)),
                          .normals = name_of(inspection_.header.find_normal(layer, "X"))};
  }

  void take_what_there_is() {
    const std::string cryptomatte = best_cryptomatte(cryptomattes_, inspection_.layout.layer);
    if (!cryptomatte.empty()) {
      take_cryptomatte(cryptomatte);
    } else {
      inspection_.likely = likely_indices(inspection_.file, inspection_.header, options_.limits);
      if (!options_.for_starter || inspection_.likely.size() != 1) return;
      inspection_.layout.channels.object_index = inspection_.likely.front();
      inspection_.planes = choose_planes(inspection_.header, inspection_.layout);
    }
    inspection_.obstacle.clear();
  }

  Inspection& inspection_;
  const InspectOptions& options_;
  std::vector<Cryptomatte> cryptomattes_;
};

void survey(Inspection& inspection, const InspectOptions& options, const RunHooks& hooks) {
  PassSurveyor surveyor(inspection.layout, options.limits);
  const auto& frames = inspection.sequence.frames;
  Progress progress{.clip = inspection.group.folder.filename().string(),
                    .done = 0,
                    .total = options.all_frames ? static_cast<int>(frames.size()) : 1};
  for (const auto& [name, is_gap] : frames) {
    if (hooks.stop_wanted()) throw Cancelled();
    if (!is_gap) surveyor.add(file_in(inspection.group, name.name));
    if (!is_gap && !options.all_frames) break;
    ++progress.done;
    if (options.all_frames) hooks.report(progress);
  }
  inspection.survey = surveyor.found();
  const auto& bad = inspection.survey.bad_frames;
  if (inspection.obstacle.empty() && inspection.survey.frames == 0 && !bad.empty())
    inspection.obstacle = bad.front().reason;
}

}  // namespace

Inspection inspect(const InspectOptions& options, const RunHooks& hooks) {
  Inspection inspection;
  inspection.group = only_group(options.passes);
  inspection.manifest = manifest_of(inspection.group, options);
  inspection.sequence = sequence_to_inspect(inspection.group, inspection.manifest);
  inspection.file = first_file(inspection.group, inspection.sequence);
  inspection.layout = layout_of(inspection.manifest, options);
  read_header(inspection, options.limits);
  Choice choice(inspection, options);
  if (!is_index_picture(inspection.file)) choice.make();
  survey(inspection, options, hooks);
  choice.reconsider();
  return inspection;
}

std::string object_name(const Inspection& inspection, int index) {
  if (index == kSkyIndex) return "sky";
  if (!inspection.manifest) return "";
  for (const ManifestObject& object : inspection.manifest->objects)
    if (object.index == index) return object.name;
  return "not in the manifest";
}

namespace {

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json gaps_of(const FrameSequence& sequence) {
  Json gaps = Json::array();
  for (const auto& [name, is_gap] : sequence.frames)
    if (is_gap) gaps.push_back(name.name);
  return gaps;
}

Json channels_of(const ExrHeader& header) {
  Json channels = Json::array();
  for (const ExrChannel& channel : header.channels) {
    channels.push_back({{"name", channel.name},
                        {"part", channel.part},
                        {"layer", channel.layer},
                        {"pass", channel.pass},
                        {"component", channel.component},
                        {"type", channel.type},
                        {"compression", channel.compression}});
  }
  return channels;
}

Json objects_of(const Inspection& inspection) {
  Json objects = Json::array();
  for (const auto& [index, pixels] : inspection.survey.objects)
    objects.push_back({{"index", index}, {"pixels", pixels}, {"name", object_name(inspection, index)}});
  return objects;
}

Json materials_of(const PassSurvey& survey) {
  Json materials = Json::array();
  for (const auto& [index, pixels] : survey.materials)
    materials.push_back({{"index", index}, {"pixels", pixels}});
  return materials;
}

Json colours_of(const PassSurvey& survey) {
  Json colours = Json::array();
  for (const auto& [colour, pixels] : survey.colours)
    colours.push_back({{"colour", colour}, {"pixels", pixels}});
  return colours;
}

Json mattes_of(const std::map<std::uint32_t, PassSurvey::Matte>& mattes) {
  Json found = Json::array();
  for (const auto& [hash, matte] : mattes) {
    found.push_back({{"hash", fmt::format("{:08x}", hash)},
                     {"name", text_or_null(matte.name)},
                     {"pixels", matte.pixels}});
  }
  return found;
}

Json cryptomattes_of(const PassSurvey& survey) {
  Json cryptomattes = Json::array();
  for (const auto& [name, mattes] : survey.cryptomattes)
    cryptomattes.push_back({{"name", name}, {"mattes", mattes_of(mattes)}});
  return cryptomattes;
}

Json depth_of(const PassSurvey& survey) {
  if (!survey.depth) return nullptr;
  return {{"nearest_m", survey.depth->nearest_m}, {"farthest_m", survey.depth->farthest_m}};
}

Json bad_frames_of(const PassSurvey& survey) {
  Json frames = Json::array();
  for (const PassSurvey::BadFrame& frame : survey.bad_frames)
    frames.push_back({{"file", frame.file}, {"reason", frame.reason}});
  return frames;
}

Json conversion_of(const Inspection& inspection) {
  return {{"possible", inspection.obstacle.empty()},
          {"obstacle", text_or_null(inspection.obstacle)},
          {"object_index", text_or_null(inspection.planes.objects)},
          {"cryptomatte", text_or_null(inspection.cryptomatte)},
          {"material_index", text_or_null(inspection.planes.materials)},
          {"depth", text_or_null(inspection.planes.depth)},
          {"normal", text_or_null(inspection.planes.normals)},
          {"likely_object_index", inspection.likely},
          {"has_manifest", inspection.manifest.has_value()}};
}

}  // namespace

Json to_json(const Inspection& inspection) {
  const FrameSequence& sequence = inspection.sequence;
  Json report = {{"file", inspection.file.string()},
                 {"files", sequence.frames.size() - static_cast<std::size_t>(sequence.gaps())},
                 {"missing", gaps_of(sequence)},
                 {"frames_read", inspection.survey.frames},
                 {"width_px", inspection.header.width_px},
                 {"height_px", inspection.header.height_px},
                 {"compression", inspection.header.compression},
                 {"channels", channels_of(inspection.header)},
                 {"objects", objects_of(inspection)},
                 {"materials", materials_of(inspection.survey)},
                 {"colours", colours_of(inspection.survey)},
                 {"cryptomattes", cryptomattes_of(inspection.survey)},
                 {"cryptomatte_faults", inspection.cryptomatte_faults},
                 {"depth", depth_of(inspection.survey)},
                 {"bad_frames", bad_frames_of(inspection.survey)},
                 {"conversion", conversion_of(inspection)}};
  if (const auto& window = inspection.window) {
    report["data_window"] = {{"x_px", window->x_px},
                             {"y_px", window->y_px},
                             {"width_px", window->width_px},
                             {"height_px", window->height_px}};
  }
  if (inspection.manifest && inspection.manifest->overscan_px > 0)
    report["overscan_px"] = inspection.manifest->overscan_px;
  if (inspection.manifest && !inspection.manifest->lens.is_none())
    report["distortion"] = to_json(inspection.manifest->lens);
  return report;
}

}  // namespace thermal
