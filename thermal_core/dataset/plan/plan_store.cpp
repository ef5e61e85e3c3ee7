#include "dataset/plan/plan_store.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/relative_name.h"
#include "io/bake/baked_files.h"
#include "io/bake/ground_maps_file.h"
#include "io/json/file.h"
#include "io/system/locks.h"
#include "io/system/sha256.h"
#include "raycast/ground_light.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

using Sums = std::map<std::string, std::string>;  ///< SHA-256 by name, relative to the folder

constexpr const char* kSumsName = "checksums.json";

/// IoError, or TryAgainError if the disk is full.
std::vector<std::string> names_in(const Path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  std::filesystem::recursive_directory_iterator entry(folder, error);
  for (const std::filesystem::recursive_directory_iterator end; !error && entry != end;
       entry.increment(error)) {
    if (entry->is_regular_file() && !entry->is_symlink())
      names.push_back(entry->path().lexically_relative(folder).string());
  }
  if (error) fail_at("read", folder, error.value());
  std::erase(names, kSumsName);
  return names;
}

/// IoError if one cannot be read.
Sums sums_of(const Path& folder, const std::vector<std::string>& names) {
  std::vector<std::string> sums(names.size());
  parallel_for(names.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t place = begin; place < end; ++place) sums[place] = sha256_of_file(folder / names[place]);
  });
  Sums found;
  for (std::size_t place = 0; place < names.size(); ++place) found[names[place]] = sums[place];
  return found;
}

/// DataError if there are none.
Sums recorded_in(const Path& folder) {
  const Path file = folder / kSumsName;
  if (!std::filesystem::exists(file))
    throw DataError(fmt::format("{} is missing; run veldt plan again", file.string()));
  const Json json = read_json(file);
  bool is_sound = json.is_object();
  if (is_sound)
    for (const auto& [name, sum] : json.items())
      is_sound = is_sound && sum.is_string() && RelativeName::of(name).has_value();
  if (!is_sound) throw DataError(fmt::format("{} is damaged; run veldt plan again", file.string()));
  return json.get<Sums>();
}

std::vector<std::string> names_of(const Sums& sums) {
  std::vector<std::string> names;
  for (const auto& [name, sum] : sums) names.push_back(name);
  return names;
}

/// DataError for the first file that is not as recorded.
void check(const Path& folder, const std::vector<std::string>& names, const Sums& recorded) {
  for (const auto& [name, sum] : sums_of(folder, names)) {
    const auto wanted = recorded.find(name);
    if (wanted == recorded.end() || wanted->second != sum)
      throw DataError(fmt::format(
          "{} is damaged, or of another plan: its SHA-256 is {}; {} has {}; run veldt plan again",
          (folder / name).string(), sum, kSumsName, wanted == recorded.end() ? "none" : wanted->second));
  }
}

void check_all(const Path& folder) {
  const Sums recorded = recorded_in(folder);
  check(folder, names_of(recorded), recorded);
}

bool is_unchanged(const Path& file, const std::string& sha256) {
  try {
    return sha256_of_file(file) == sha256;
  } catch (const IoError&) {
    return false;
  }
}

bool needs_ground_maps(const DatasetSpec& spec) { return spec.physical && spec.heat_balance; }

/// The disk space and the memory of a run are reckoned for the config's pictures.
void check_size(const CameraIntrinsics& camera, const CameraIntrinsics& wanted, const Path& file) {
  if (camera.width_px == wanted.width_px && camera.height_px == wanted.height_px) return;
  throw DataError(
      fmt::format("{}: {}", file.string(),
                  fault("camera", fmt::format("{} x {}", camera.width_px, camera.height_px), "px",
                        fmt::format("{} x {}, as in the config", wanted.width_px, wanted.height_px))));
}

/// A config of veldt plan's own: what is wrong with it is a fault of the file.
ResolvedConfig read_resolved(const Path& file, const Assets& assets) {
  try {
    return resolve_config(read_json(file), file.string(), assets);
  } catch (const ConfigError& fault) {
    throw DataError(fault.what());
  }
}

}  // namespace

std::vector<SunPath> sun_paths(const DatasetSpec& spec) {
  std::vector<SunPath> paths;
  for (const FlownWeather& flown : flown_weather(spec)) {
    const SunPath& path = flown.weather.day.sun;
    if (std::ranges::count(paths, path) == 0) paths.push_back(path);
  }
  return paths;
}

bool PlanStore::exists() const { return std::filesystem::exists(plan_file()); }

PlanStore PlanStore::unfinished() const {
  Path part = folder_;
  return {part += ".part", assets_};
}

PlanState PlanStore::state(const ResolvedConfig& config, bool preview) const {
  using enum PlanState::Kind;
  PlanState found;
  try {
    if (!exists()) throw DataError(plan_file().string() + " is missing");
    if (preview && !std::filesystem::exists(folder_ / "preview"))
      throw DataError((folder_ / "preview").string() + " is missing");
    found.kind = damaged;
    const Json document = read_json(plan_file());
    if (document.is_object() && document.contains("version") && document.at("version") != kPlanVersion)
      found.kind = other_version;
    found.plan = plan_of(document, plan_file().string(), assets_);
    found.kind = other_config;
    check_is_made_from(found.plan, config);
    found.kind = damaged;
    check_all(folder_);
    found.kind = lacks_ground_maps;
    if (!preview) check_ground_days(config.spec);
    found.kind = complete;
  } catch (const Error& fault) {
    found.why = fault.what();
  }
  return found;
}

void PlanStore::check_is_made_from(const DatasetPlan& plan, const ResolvedConfig& config) const {
  const Json part = planned_part(config);
  if (plan.config != part)
    throw DataError(fmt::format("{} is of another config: {}", plan_file().string(),
                                fmt::join(differences(part, plan.config), ", ")));
  for (const auto& [file, sha256] : plan.files)
    if (!is_unchanged(assets_.home() / file, sha256))  // an absolute path replaces home()
      throw DataError(fmt::format("{} was made from another {}", plan_file().string(), file));
}

void PlanStore::check_ground_days(const DatasetSpec& spec) const {
  if (!needs_ground_maps(spec)) return;
  const std::vector<SunPath> known = sun_paths_of_maps(folder_, assets_);
  for (const SunPath& path : sun_paths(spec))
    if (std::ranges::count(known, path) == 0)
      throw DataError(fmt::format("{} has no maps of the ground for day {} at {} deg; run veldt plan again",
                                  folder_.string(), path.day_of_year, path.latitude_deg));
}

PlannedDataset PlanStore::plan(const ResolvedConfig& config, const std::string& name,
                               const PlanOptions& options,
                               const std::function<void(const ResolvedConfig& cut)>& may_replace) const {
  PlanState found = state(config, options.preview);
  if (found.kind != PlanState::Kind::complete) found.plan = made_again(config, name, options, may_replace);
  const std::optional<LeftOver> left_over = sweep_unless_locked(unfinished().folder_);
  if (left_over && options.left_over) options.left_over(*left_over);
  ResolvedConfig cut = with_flights_cut(config, found.plan, plan_file().string());
  return {.config = std::move(cut), .plan = std::move(found.plan)};
}

DatasetPlan PlanStore::made_again(const ResolvedConfig& config, const std::string& name,
                                  const PlanOptions& options,
                                  const std::function<void(const ResolvedConfig& cut)>& may_replace) const {
  const PlanStore part = unfinished();
  const LockedFolder locked(part.folder_);
  PlanState found = state(config, options.preview);  // another run may have made it
  if (found.kind == PlanState::Kind::lacks_ground_maps) {
    add_ground_maps(part.folder_, config.spec, found.plan, options);
    write_checksums();  // killed in between, the plan is damaged, and made again
  } else if (found.kind != PlanState::Kind::complete) {
    std::vector<std::string> arguments = {"--out", part.folder_.string()};
    if (is_undamaged()) arguments.insert(arguments.end(), {"--earlier", folder_.string()});
    if (!options.blender.empty()) arguments.insert(arguments.end(), {"--blender", options.blender.string()});
    if (options.preview) arguments.emplace_back("--preview");
    found.plan = run_planner(config, name, options, arguments);
    if (may_replace) may_replace(with_flights_cut(config, found.plan, part.plan_file().string()));
    part.add_ground_maps(part.folder_, config.spec, found.plan, options);
    part.write_checksums();
    replace_folder(part.folder_, folder_);
  }
  return std::move(found.plan);
}

bool PlanStore::is_undamaged() const {
  try {
    check_all(folder_);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// Light where the clips may see the ground or, where cameras may fly anywhere, everywhere; on all cores.
void PlanStore::add_ground_maps(const Path& scratch, const DatasetSpec& spec, const DatasetPlan& plan,
                                const PlanOptions& options) const {
  if (options.preview || !needs_ground_maps(spec)) return;
  with_threads(options.threads, [&] {
    std::vector<SunDay> days;
    for (const SunPath& path : sun_paths(spec)) days.push_back({.path = path, .sun = sun_hours(path)});
    const auto show_cells = [&options](int done, int total) {
      if (options.show_maps) options.show_maps({.clip = "ground maps", .done = done, .total = total});
    };
    const BakedScene scene = this->scene(spec);
    std::optional<std::vector<GroundView>> views;
    if (!spec.poses_all) views = ground_views(plan, scene);
    write_ground_maps(make_ground_maps(scene, days, views, show_cells), folder_, scratch);
  });
}

void PlanStore::write_checksums() const {
  write_file_atomically(folder_ / kSumsName, to_text(Json(sums_of(folder_, names_in(folder_)))));
}

PlannedDataset PlanStore::plan_with_config(const ResolvedConfig& config, const std::string& name,
                                           const PlanOptions& options) const {
  const std::string text = to_text(config.document);
  PlannedDataset planned = plan(config, name, options, [&](const ResolvedConfig& /*cut*/) {
    write_file_atomically(unfinished().config_file(), text);
  });
  if (!has_content(config_file(), text)) {  // what is not planned may have changed
    write_file_atomically(config_file(), text);
    write_checksums();
  }
  return planned;
}

PlannedDataset PlanStore::open() const {
  for (const Path& file : {plan_file(), config_file()})
    if (!std::filesystem::exists(file))
      throw ConfigError(fault("--plan", folder_.string(), "",
                              "a folder that veldt plan wrote, with " + file.filename().string()));
  check(folder_, {"plan.json", "config.json"}, recorded_in(folder_));
  DatasetPlan plan = plan_of(read_json(plan_file()), plan_file().string(), assets_);
  ResolvedConfig cut = with_flights_cut(read_resolved(config_file(), assets_), plan, plan_file().string());
  return {.config = std::move(cut), .plan = std::move(plan)};
}

void PlanStore::check_clips(const std::vector<std::string>& clips) const {
  const std::set<std::string> read(clips.begin(), clips.end());
  const Sums recorded = recorded_in(folder_);
  std::vector<std::string> names = names_of(recorded);
  std::erase_if(names, [&read](const Path& name) {
    return name.parent_path() == "tracks" && !read.contains(name.stem().string());
  });
  check(folder_, names, recorded);
}

BakedScene PlanStore::scene(const DatasetSpec& spec) const {
  BakedScene scene = read_baked_scene(folder_, assets_);
  check_size(scene.camera, spec.settings->camera, folder_ / "scene.json");
  return scene;
}

BakedTrack PlanStore::track(const std::string& clip, int frames, const BakedScene& scene) const {
  BakedTrack track = read_baked_track(folder_, clip, scene, assets_);
  const Path file = folder_ / "tracks" / (clip + ".json");
  if (track.frames != static_cast<std::size_t>(frames))
    throw DataError(fmt::format(
        "{}: {}", file.string(),
        fault("frames", std::to_string(track.frames), "", fmt::format("{}, as plan.json has them", frames))));
  if (track.camera) check_size(*track.camera, scene.camera, file);
  return track;
}

std::vector<GroundView> PlanStore::ground_views(const DatasetPlan& plan, const BakedScene& scene) const {
  std::vector<GroundView> views;
  for (const ClipPlan& clip : plan.clips) {
    const BakedTrack track = this->track(clip.id, clip.frames, scene);
    Manifest manifest;
    manifest.camera = track.camera.value_or(scene.camera);
    manifest.overscan_px = scene.view_margin_px;
    views.push_back({.camera = pixels_camera(manifest),
                     .camera_to_world = {track.camera_to_world.begin(), track.camera_to_world.end()}});
  }
  return views;
}

std::shared_ptr<const GroundMaps> PlanStore::ground_maps(const DatasetSpec& spec,
                                                         const BakedScene& scene) const {
  if (!needs_ground_maps(spec)) return nullptr;
  check_ground_days(spec);
  return std::make_shared<const GroundMaps>(read_ground_maps(folder_, scene.ground, assets_));
}

void PlanStore::copy_ground_maps(const Path& passes) const {
  constexpr auto kReplace = std::filesystem::copy_options::overwrite_existing;
  for (const char* name : {"ground.bin", "ground.json"})
    if (std::filesystem::exists(folder_ / name))
      std::filesystem::copy_file(folder_ / name, passes / name, kReplace);
}

PlannedDataset plan_in_dataset(const Path& out, const ResolvedConfig& config, const std::string& name,
                               const PlanOptions& options, CheckOut check) {
  const Layout layout{out};
  const bool was_there = std::filesystem::exists(out);
  try {
    const FolderLock lock(out, {});
    PlannedDataset planned;
    lock.in_turn([&] {
      if (options.preview) make_own_folder(layout.preview());
      const PlanStore store(options.preview ? layout.preview() / "plan" : layout.plan(), options.assets);
      planned = store.plan(config, name, options, [&](const ResolvedConfig& cut) {
        if (check != nullptr) check(layout, cut);
      });
    });
    return planned;
  } catch (...) {
    if (!was_there) (void)sweep_folder(out);  // with nothing in it
    throw;
  }
}

}  // namespace thermal
