#include "dataset/plan/planner.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text.h"
#include "dataset/dataset_index.h"
#include "dataset/run/passes_folder.h"
#include "io/bake/baked_files.h"
#include "io/bake/ground_maps_file.h"
#include "io/config/asset_files.h"
#include "io/json/file.h"
#include "io/system/child_process.h"
#include "io/system/files.h"
#include "io/system/locks.h"
#include "io/system/sha256.h"
#include "raycast/ground_light.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

/// A fault that the planner found, which counts clips and flights one by one: "clips[7].flight …" of entry `clips[2]`.
std::string with_entry_named(const std::string& line, const EntryNames& entries) {
  const std::string_view text = line;
  const std::size_t begin = text.find('[');
  const std::size_t end = text.find(']');
  const auto list = entries.find(line.substr(0, begin));
  if (list == entries.end() || end == std::string_view::npos) return line;
  const auto number = number_in<std::size_t>(text.substr(begin + 1, end - begin - 1));
  return number && *number < list->second.size() ? list->second[*number] + line.substr(end + 1) : line;
}

/// Of each line that the planner printed.
std::vector<std::string> faults_in(const std::string& text, const EntryNames& entries) {
  std::vector<std::string> faults;
  for (const std::string_view line : split(text, '\n'))
    if (!line.empty()) faults.push_back(with_entry_named(std::string(line), entries));
  return faults;
}

/// Passes on an event of the script; a line that is none would be its fault, not the user's.
void show_event(const std::string& line, const PlanOptions& options) {
  const Json event = Json::parse(line, nullptr, false);
  if (options.show && event.is_object() && event.value("event", "") == "planned")
    options.show(
        {.clip = event.value("id", ""), .done = event.value("done", 0), .total = event.value("total", 0)});
}

/// For a planner that failed, but not because of the config.
[[noreturn]] void throw_failure(const std::string& planner, const Output& output) {
  constexpr int kTryAgain = 75;  // the disk is full, or a process of the planner was killed
  std::string message = fmt::format("{} {}", planner, output.status.in_words());
  if (output.status.signal == SIGKILL) {
    message += fmt::format("; {}", kKilledHint);
  } else if (const std::string why = printable(output.last_error_line()); !why.empty()) {
    message += ": " + why;
  }
  if (output.status.is_killed() || output.status.code == kTryAgain) throw TryAgainError(message);
  throw IoError(message);
}

/// Runs the script with additional arguments, and returns what it prints.
std::string run_planning(const ResolvedConfig& config, const std::string& name, const PlanOptions& options,
                         const std::vector<std::string>& arguments) {
  const Path python = find_python();
  if (python.empty()) throw IoError("no python3 on PATH; install it (apt-get install python3-numpy)");
  const Json planned = planned_part(config);
  try {
    check_asset_files(planned.at("scene"), options.assets);
  } catch (const ConfigError& fault) {
    throw_faults({fault.what()}, name);
  }
  const Path script = options.assets.script("plan_scene.py");
  std::vector<std::string> command = {python.string(),
                                      "-I",
                                      script.string(),
                                      "--config",
                                      "-",
                                      "--processes",
                                      std::to_string(thread_count(options.threads)),
                                      "--events-fd",
                                      std::to_string(ChildProcess::kEventDescriptor)};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const Output output = run_program(command, to_text(planned),
                                    [&options](const std::string& line) { show_event(line, options); });
  constexpr int kConfigFault = 2;
  if (output.status.signal == 0 && output.status.code == kConfigFault)
    throw_faults(faults_in(output.error, config.entries), name);
  if (output.status.signal != 0 || output.status.code != 0)
    throw_failure(fmt::format("{} {}", python.string(), script.filename().string()), output);
  return output.out;
}

/// The plan in a folder, if there is a complete one of this version.
std::optional<DatasetPlan> plan_in(const Path& folder, const Assets& assets) {
  const Path file = folder / "plan.json";
  if (!std::filesystem::exists(file)) return std::nullopt;
  try {
    return plan_of(read_json(file), file.string(), assets);
  } catch (const Error&) {  // of another version, or damaged: it is made again
    return std::nullopt;
  }
}

bool is_unchanged(const std::string& file, const std::string& sha256, const Assets& assets) {
  try {
    return sha256_of_file(assets.home() / file) == sha256;  // an absolute path replaces home()
  } catch (const IoError&) {
    return false;
  }
}

bool is_made_from(const DatasetPlan& plan, const ResolvedConfig& config, const Assets& assets) {
  return plan.config == planned_part(config) && std::ranges::all_of(plan.files, [&assets](const auto& file) {
           return is_unchanged(file.first, file.second, assets);
         });
}

/// The plan in a folder, unless it is of another config, was made from other files, or is damaged. Its own files, which
/// may be large, are read last.
std::optional<DatasetPlan> current_plan(const Path& folder, const ResolvedConfig& config,
                                        const PlanOptions& options) {
  std::optional<DatasetPlan> plan = plan_in(folder, options.assets);
  const bool has_pictures = !options.preview || std::filesystem::exists(folder / "preview");
  if (plan && has_pictures && is_made_from(*plan, config, options.assets) && has_its_checksums(folder))
    return plan;
  return std::nullopt;
}

std::vector<std::string> baking_arguments(const Path& part, const Path& earlier, const PlanOptions& options) {
  std::vector<std::string> arguments = {"--out", part.string()};
  if (has_its_checksums(earlier)) arguments.insert(arguments.end(), {"--earlier", earlier.string()});
  if (!options.blender.empty()) arguments.insert(arguments.end(), {"--blender", options.blender.string()});
  if (options.preview) arguments.emplace_back("--preview");
  return arguments;
}

/// Previews need no maps.
bool has_its_maps(const Path& folder, const DatasetSpec& spec, const PlanOptions& options) {
  return options.preview || has_needed_ground_maps(folder, spec, options.assets);
}

/// Adds the maps that a plan's folder lacks, through `part`, and their checksums. A plan that is killed in between does
/// not agree with its checksums, and is made again.
void complete_maps(const Path& folder, const Path& part, const DatasetSpec& spec, const DatasetPlan& plan,
                   const PlanOptions& options) {
  if (has_its_maps(folder, spec, options)) return;
  with_threads(options.threads,
               [&] { add_ground_maps(folder, part, spec, plan, options.assets, options.show_maps); });
  write_checksums(folder);
}

}  // namespace

Path find_python() {
  if (const char* named = std::getenv("VELDT_PYTHON"); named != nullptr && *named != '\0')
    return find_program(named);
  const Path system = find_program("/usr/bin/python3");
  return system.empty() ? find_program("python3") : system;
}

DatasetPlan plan_dataset(const ResolvedConfig& config, const std::string& name, const PlanOptions& options) {
  constexpr const char* kScript = "plan_scene.py";
  return plan_of(parse_json(run_planning(config, name, options, {}), kScript), kScript, options.assets);
}

Path unfinished_plan(const Path& folder) {
  Path part = folder;
  return part += ".part";
}

namespace {

DatasetPlan plan_again(const Path& folder, const ResolvedConfig& config, const std::string& name,
                       const PlanOptions& options,
                       const std::function<void(const DatasetPlan&)>& may_replace) {
  const Path part = unfinished_plan(folder);
  const LockedFolder locked(part);
  if (auto plan = current_plan(folder, config, options)) {  // another run has made it, or it lacks maps
    complete_maps(folder, part, config.spec, *plan, options);
    return *std::move(plan);
  }
  (void)run_planning(config, name, options, baking_arguments(part, folder, options));
  DatasetPlan plan = plan_of(read_json(part / "plan.json"), (part / "plan.json").string(), options.assets);
  if (may_replace) may_replace(plan);
  complete_maps(part, part, config.spec, plan, options);
  write_checksums(part);
  replace_folder(part, folder);
  return plan;
}

}  // namespace

DatasetPlan plan_into(const Path& folder, const ResolvedConfig& config, const std::string& name,
                      const PlanOptions& options,
                      const std::function<void(const DatasetPlan&)>& may_replace) {
  std::optional<DatasetPlan> plan = current_plan(folder, config, options);
  if (!plan || !has_its_maps(folder, config.spec, options))
    plan = plan_again(folder, config, name, options, may_replace);
  const std::optional<LeftOver> left_over = sweep_unless_locked(unfinished_plan(folder));
  if (left_over && options.left_over) options.left_over(*left_over);
  return *std::move(plan);
}

namespace {

void add_once(const SunPath& path, std::vector<SunPath>& paths) {
  if (std::ranges::count(paths, path) == 0) paths.push_back(path);
}

/// Of an earlier plan: none if they cannot be read.
std::vector<SunPath> paths_in(const Path& folder, const Assets& assets) {
  try {
    return sun_paths_of_maps(folder, assets);
  } catch (const Error&) {  // missing, of another version, or damaged: they are made again
    return {};
  }
}

}  // namespace

bool needs_ground_maps(const DatasetSpec& spec) { return spec.physical && spec.heat_balance; }

std::vector<SunPath> sun_paths(const DatasetSpec& spec) {
  std::vector<SunPath> paths;
  for (const FlownWeather& flown : flown_weather(spec)) add_once(flown.weather.day.sun, paths);
  return paths;
}

bool has_needed_ground_maps(const Path& folder, const DatasetSpec& spec, const Assets& assets) {
  if (!needs_ground_maps(spec)) return true;
  const std::vector<SunPath> known = paths_in(folder, assets);
  return std::ranges::all_of(sun_paths(spec),
                             [&known](const SunPath& path) { return std::ranges::count(known, path) > 0; });
}

std::vector<GroundView> ground_views(const Path& folder, const DatasetPlan& plan, const BakedScene& scene,
                                     const Assets& assets) {
  std::vector<GroundView> views;
  for (const ClipPlan& clip : plan.clips) {
    const BakedTrack track = read_baked_track(folder, clip.id, scene, assets);
    Manifest manifest;
    manifest.camera = track.camera.value_or(scene.camera);
    manifest.overscan_px = scene.view_margin_px;
    views.push_back({.camera = pixels_camera(manifest),
                     .camera_to_world = {track.camera_to_world.begin(), track.camera_to_world.end()}});
  }
  return views;
}

bool uses_ground_maps(const Path& folder, const DatasetSpec& spec) {
  return needs_ground_maps(spec) && has_ground_maps(folder);
}

std::shared_ptr<const GroundMaps> read_needed_ground_maps(const Path& folder, const DatasetSpec& spec,
                                                          const Assets& assets) {
  if (!uses_ground_maps(folder, spec)) return nullptr;
  const BakedScene scene = read_baked_scene(folder, assets);
  return std::make_shared<const GroundMaps>(read_ground_maps(folder, scene.ground, assets));
}

void add_ground_maps(const Path& folder, const Path& scratch, const DatasetSpec& spec,
                     const DatasetPlan& plan, const Assets& assets,
                     const std::function<void(const Progress&)>& show) {
  std::vector<SunDay> days;
  for (const SunPath& path : sun_paths(spec)) days.push_back({.path = path, .sun = sun_hours(path)});
  const auto show_cells = [&show](int done, int total) {
    if (show) show({.clip = "ground maps", .done = done, .total = total});
  };
  const BakedScene scene = read_baked_scene(folder, assets);
  std::optional<std::vector<GroundView>> views;
  if (!spec.poses_all) views = ground_views(folder, plan, scene, assets);
  write_ground_maps(make_ground_maps(scene, days, views, show_cells), folder, scratch);
}

namespace {

Path config_in(const Path& folder) { return folder / "config.json"; }

void check_is_there(const Path& folder) {
  for (const Path& file : {folder / "plan.json", config_in(folder)})
    if (!std::filesystem::exists(file))
      throw ConfigError(fault("--plan", folder.string(), "",
                              "a folder that veldt plan wrote, with " + file.filename().string()));
}

bool has_text(const Path& file, const std::string& text) {
  return std::filesystem::exists(file) && read_file(file) == text;
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

PlannedDataset plan_with_config(const Path& folder, const ResolvedConfig& config, const std::string& name,
                                const PlanOptions& options) {
  const std::string text = to_text(config.document);
  DatasetPlan plan = plan_into(folder, config, name, options, [&](const DatasetPlan&) {
    write_file_atomically(config_in(unfinished_plan(folder)), text);
  });
  if (!has_text(config_in(folder), text)) {  // what is not planned may have changed
    write_file_atomically(config_in(folder), text);
    write_checksums(folder);
  }
  ResolvedConfig cut = with_flights_cut(config, plan, (folder / "plan.json").string());
  return {.config = std::move(cut), .plan = std::move(plan)};
}

PlannedDataset open_plan(const Path& folder, const Assets& assets) {
  check_is_there(folder);
  check_files(folder, {"plan.json", config_in(folder).filename().string()});
  const Path file = folder / "plan.json";
  DatasetPlan plan = plan_of(read_json(file), file.string(), assets);
  ResolvedConfig cut = with_flights_cut(read_resolved(config_in(folder), assets), plan, file.string());
  return {.config = std::move(cut), .plan = std::move(plan)};
}

namespace {

/// Calls `plan` while no other run changes the folder. A folder that a failure leaves with nothing in it is removed.
DatasetPlan in_turn(const Path& out, const std::function<DatasetPlan()>& plan) {
  const bool was_there = std::filesystem::exists(out);
  try {
    const FolderLock lock(out, {});
    DatasetPlan planned;
    lock.in_turn([&] { planned = plan(); });
    return planned;
  } catch (...) {
    if (!was_there) (void)sweep_folder(out);
    throw;
  }
}

/// `check` compares the folder's own config with the planned one.
DatasetPlan plan_for(const Path& out, const ResolvedConfig& config, const std::string& name,
                     const PlanOptions& options,
                     void (*check)(const Layout& layout, const ResolvedConfig& config)) {
  const Layout layout{out};
  return in_turn(out, [&] {
    const std::string made = (unfinished_plan(layout.plan()) / "plan.json").string();
    return plan_into(layout.plan(), config, name, options,
                     [&](const DatasetPlan& plan) { check(layout, with_flights_cut(config, plan, made)); });
  });
}

}  // namespace

DatasetPlan plan_to_generate(const Path& out, const ResolvedConfig& config, const std::string& name,
                             const PlanOptions& options) {
  return plan_for(out, config, name, options, check_same_dataset);
}

DatasetPlan plan_to_render(const Path& out, const ResolvedConfig& config, const std::string& name,
                           const PlanOptions& options) {
  return plan_for(out, config, name, options, check_same_passes);
}

DatasetPlan plan_to_preview(const Path& out, const ResolvedConfig& config, const std::string& name,
                            PlanOptions options) {
  options.preview = true;
  const Path folder = Layout{out}.preview();
  return in_turn(out, [&] {
    make_own_folder(folder);
    return plan_into(folder / "plan", config, name, options);
  });
}

}  // namespace thermal
