#include "dataset/view/view.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/pipeline.h"
#include "base/version.h"
#include "dataset/clip/record.h"
#include "dataset/exports/export_folder.h"
#include "dataset/videos/clip_source.h"
#include "dataset/videos/palette.h"
#include "dataset/videos/trails.h"
#include "dataset/view/clip_figures.h"
#include "io/system/base64.h"

namespace thermal {
namespace {

constexpr const char* kViewRecord = "view.json";
constexpr const char* kViewFormat = "veldt-view";
constexpr const char* kPage = "index.html";

/// Files of the page, copied from assets/, by their folder there.
constexpr std::array<std::pair<const char*, const char*>, 11> kCode = {{{"report", "style.css"},
                                                                        {"report", "elements.js"},
                                                                        {"view", "view.css"},
                                                                        {"view", "png.js"},
                                                                        {"view", "frames.js"},
                                                                        {"view", "masks.js"},
                                                                        {"view", "drawing.js"},
                                                                        {"view", "panels.js"},
                                                                        {"view", "keys.js"},
                                                                        {"view", "screen.js"},
                                                                        {"view", "page.js"}}};

/// A script that passes JSON to a function of the page. ASCII, so that its bytes mean the same in any encoding.
std::string call_of(const char* function, const Json& json) {
  return fmt::format("{}({});\n", function, json.dump(-1, ' ', true, Json::error_handler_t::replace));
}

bool is_view(const Path& folder) {
  try {
    check_is_no_link(folder / kViewRecord);
    return read_json(folder / kViewRecord).value("format", Json()) == kViewFormat;
  } catch (const Error&) {
    return false;
  } catch (const Json::exception&) {  // not an object
    return false;
  }
}

void check_view_out(const Path& out) {
  const auto fault_of = [&out](const char* rule) {
    return ConfigError(fault("--out", fmt::format("\"{}\"", out.string()), "", rule));
  };
  if (out.extension() == ".html") throw fault_of("the name of a folder, in which the page is index.html");
  if (!std::filesystem::exists(out)) return;
  if (!std::filesystem::is_directory(out)) throw fault_of("a folder");
  if (!std::filesystem::is_empty(out) && !is_view(out))
    throw fault_of("an empty or new folder, or the page of an earlier veldt view");
}

Json palettes_of_page() {
  Json palettes = Json::array();
  for (const std::string& name : palette_names()) {
    std::string bytes;
    for (const PaletteColour& colour : palette_table(name)) bytes.append(colour.begin(), colour.end());
    palettes.push_back({{"name", name}, {"colours", base64_of(bytes)}});
  }
  return palettes;
}

std::int64_t bytes_below(const Path& folder) {
  std::int64_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) bytes += static_cast<std::int64_t>(entry.file_size());
  return bytes;
}

/// Writes the files of one page.
class ViewWriter {
 public:
  ViewWriter(const FilmedDataset& dataset, Path folder, const RunHooks& hooks)
      : dataset_(dataset), folder_(std::move(folder)), hooks_(hooks) {}

  void write_code(const Assets& assets) const {
    make_folder(folder_ / "code");
    for (const auto& [kind, name] : kCode) copy_content(assets.folder(kind) / name, folder_ / "code" / name);
    copy_content(assets.folder("view") / kPage, folder_ / kPage);
  }

  void write_clips(const std::vector<std::string>& ids) {
    std::vector<ClipRecord> records;
    for (const std::string& id : ids)
      records.push_back(read_clip_record(dataset_.layout.clip(id) / "clip.json"));
    std::int64_t frames = 0;
    for (const ClipRecord& record : records) frames += record.frames;
    progress_.total = static_cast<int>(std::min<std::int64_t>(frames, std::numeric_limits<int>::max()));
    for (std::size_t k = 0; k < ids.size(); ++k) write_clip(ids[k], records[k].season);
  }

  /// Writes the list of clips, and finally the record.
  ViewOutcome finish(const std::vector<std::string>& not_made) {
    write_text(Path("data") / "dataset.js",
               call_of("takeDataset", {{"name", dataset_.name},
                                       {"kelvin_per_count", dataset_.kelvin_per_count},
                                       {"palettes", palettes_of_page()},
                                       {"trail_s", kTrailSeconds},
                                       {"clips", clips_},
                                       {"not_made", not_made}}));
    write_text(kViewRecord, to_text({{"format", kViewFormat},
                                     {"version", 1},
                                     {"veldt_version", kVersion},
                                     {"dataset", dataset_.name},
                                     {"clips", clips_.size()},
                                     {"frames", frames_}}));
    return {.page = {},
            .clips = clips_.size(),
            .frames = frames_,
            .bytes = bytes_below(folder_),
            .not_made = not_made};
  }

 private:
  void write_clip(const std::string& id, const std::string& season) {
    const ClipFilm film = read_clip_film(dataset_, id, true);
    const ClipMasks masks = read_clip_masks(film);
    const Trails trails(film, kTrailSeconds);
    const FrameParts parts{
        .film = film, .masks = masks, .trails = trails, .kelvin_per_count = dataset_.kelvin_per_count};
    make_folder(folder_ / "data" / id);
    progress_.clip = id;
    constexpr std::size_t kInFlight = 8;
    run_pipeline(kInFlight, [&film](std::size_t number) { return number < film.frames.size(); },
                 {{.in_order = false, .work = [&](std::size_t number) { write_frame(parts, number); }},
                  {.in_order = true, .work = [this](std::size_t) { pass_frame(); }}});
    clips_.push_back(clip_figures(film, dataset_.camera_of(id), season));
    frames_ += film.frames.size();
  }

  void write_frame(const FrameParts& parts, std::size_t number) const {
    const std::string name = fmt::format("{:06}.js", parts.film.frames[number].frame_index);
    write_text(Path("data") / parts.film.id / name, call_of("takeFrame", frame_figures(parts, number)));
  }

  void write_text(const Path& name, const std::string& text) const {
    write_file(folder_ / name, std::as_bytes(std::span(text)));
  }

  void pass_frame() {
    if (hooks_.stop_wanted()) throw Cancelled();
    ++progress_.done;
    hooks_.report(progress_);
  }

  const FilmedDataset& dataset_;
  Path folder_;
  const RunHooks& hooks_;
  Progress progress_;
  Json clips_ = Json::array();
  std::size_t frames_ = 0;
};

std::vector<std::string> without_repeats(const std::vector<std::string>& ids) {
  std::vector<std::string> once;
  for (const std::string& id : ids)
    if (std::ranges::find(once, id) == once.end()) once.push_back(id);
  return once;
}

}  // namespace

ViewOutcome write_view(const ViewRequest& request, const RunHooks& hooks) {
  const Path out = named_folder(request.out);
  check_view_out(out);
  const ClipSource source = find_clip_source(request.source, request.clips);
  ExportFolder folder(out, {});
  ViewWriter writer(source.dataset, folder.path(), hooks);
  writer.write_code(request.assets);
  writer.write_clips(without_repeats(source.clips));
  ViewOutcome outcome = writer.finish(source.not_made());
  folder.finish_in_place_of_old();
  outcome.page = out / kPage;
  return outcome;
}

}  // namespace thermal
