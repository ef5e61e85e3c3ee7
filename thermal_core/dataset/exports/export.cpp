#include "dataset/exports/export.h"

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "base/version.h"
#include "dataset/exports/birdsai.h"
#include "dataset/exports/coco.h"
#include "dataset/exports/export_folder.h"
#include "dataset/exports/mot.h"
#include "dataset/exports/source.h"
#include "dataset/exports/tiff.h"
#include "dataset/exports/webdataset.h"
#include "dataset/exports/yolo.h"
#include "dataset/label_source.h"
#include "io/json/entry.h"
#include "io/json/file.h"
#include "io/system/files.h"

namespace thermal {
namespace {

constexpr const char* kRecord = "export.json";
constexpr int kSamplesPerShard = 1000;
constexpr int kMostSamplesPerShard = 1'000'000;

std::string why_not(ExportFormat format, const LabelSet& set, const Label& label) {
  if (format == ExportFormat::yolo) return why_not_in_yolo(set, label);
  return format == ExportFormat::birdsai ? why_not_in_birdsai(set, label) : "";
}

std::string linking_name(Linking linking) {
  constexpr std::array kNames = {"hard", "symlink", "copy"};
  return kNames[static_cast<std::size_t>(linking)];
}

int samples_per_shard(const ExportOptions& options) {
  return options.samples_per_shard.value_or(kSamplesPerShard);
}

ExportPlan make_yolo_plan(const ExportOptions& options, const ExportSource& source, SegmentMaker* segments) {
  const std::string folder = std::filesystem::absolute(options.out).lexically_normal().string();
  if (segments == nullptr) return plan_yolo(source.input, folder);
  const Outlines outlines = yolo_outlines(source.input, source.coco, source.coco_name, *segments);
  return plan_yolo(source.input, folder, &outlines);
}

/// `segments`: null if masks are unchanged.
ExportPlan make_plan(const ExportOptions& options, const ExportSource& source, SegmentMaker* segments) {
  switch (options.format) {
    case ExportFormat::coco:
      return plan_coco(source.input, source.coco, source.coco_name, source.all, segments);
    case ExportFormat::yolo:
      return make_yolo_plan(options, source, segments);
    case ExportFormat::mot:
      return plan_mot(source.input);
    case ExportFormat::birdsai:
      return plan_birdsai(source.input);
    case ExportFormat::tiff:
      return plan_tiff(source.input, source.coco, source.coco_name);
    case ExportFormat::webdataset:
      return plan_webdataset(source.input, static_cast<std::size_t>(samples_per_shard(options)));
  }
  return {};
}

ExportOutcome tally(const ExportInput& input, ExportFormat format) {
  const LabelSet& set = input.set;
  ExportOutcome outcome;
  for (const LabelCategory& category : set.categories) outcome.categories.push_back(category.name);
  for (const std::string& name : input.splits)
    outcome.splits.push_back(
        {.name = name, .clips = 0, .pictures = 0, .labels = std::vector<int>(set.categories.size(), 0)});
  const auto split_of = [&](std::size_t image) -> ExportedSplit& {
    return outcome.splits[input.of_video[set.images[image].video]];
  };
  for (std::size_t i = 0; i < set.images.size(); ++i) {
    ++split_of(i).pictures;
    if (i == 0 || set.images[i].video != set.images[i - 1].video) ++split_of(i).clips;
  }
  for (const Label& label : set.labels) {
    const std::string why = why_not(format, set, label);
    if (why.empty()) ++split_of(label.image).labels[label.category];
    if (!why.empty()) ++outcome.left_out[why];
  }
  return outcome;
}

GeoPosition origin_of(const ExportOptions& options) {
  const GeoPosition usual = default_origin(options.source);
  return options.origin.empty() ? usual : parse_origin(options.origin, usual.height_m);
}

std::string tiff_type_name(TiffType type) { return type == TiffType::float32 ? "float32" : "uint16"; }

/// By kind: shares of width and height.
Json fills_of(const DrawnFills& fills) {
  const auto pair = [](const BoxFill& fill) { return Json{fill.width, fill.height}; };
  return {
      {"people", pair(fills.people)}, {"animals", pair(fills.animals)}, {"vehicles", pair(fills.vehicles)}};
}

/// Identifies an export: equal requests make equal folders.
Json request_of(const ExportOptions& options, const ExportSource& source) {
  Json splits = Json::object();
  for (const SplitShare& split : options.splits) splits[split.name] = split.share;
  Json request = {{"dataset", source.input.set.name},
                  {"labels_sha256", source.labels_sha256},
                  {"format", format_name(options.format)},
                  {"images", options.ir16 || options.format == ExportFormat::tiff ? "ir16" : "ir8"}};
  if (options.boxes == BoxStyle::drawn) request["box_style"] = "drawn";
  if (options.fills) request["box_fill"] = fills_of(*options.fills);
  if (options.segmentation == Segmentation::polygon) request["segmentation"] = "polygon";
  if (options.segmentation == Segmentation::rle && source.has_foreign_masks) request["segmentation"] = "rle";
  if (options.format == ExportFormat::webdataset) {
    request["samples_per_shard"] = samples_per_shard(options);
  } else if (options.format == ExportFormat::tiff) {
    const GeoPosition origin = origin_of(options);
    request["tiff_type"] = tiff_type_name(options.tiff_type.value_or(TiffType::float32));
    request["origin"] = {{"latitude_deg", origin.latitude_deg},
                         {"longitude_deg", origin.longitude_deg},
                         {"height_m", origin.height_m}};
  } else {
    request["link"] = linking_name(options.linking.value_or(Linking::hard));
  }
  if (!options.splits.empty()) request["split"] = splits;
  if (!options.splits.empty()) request["seed"] = source.seed;
  if (!options.selection.empty()) request["selection_sha256"] = sha256_of_file(options.selection);
  return request;
}

std::string record_of(const Json& request, const ExportOutcome& outcome) {
  Json splits = Json::object();
  for (const ExportedSplit& split : outcome.splits) {
    Json labels = Json::object();
    for (std::size_t i = 0; i < split.labels.size(); ++i) labels[outcome.categories[i]] = split.labels[i];
    splits[split.name] = {{"clips", split.clips}, {"pictures", split.pictures}, {"labels", labels}};
  }
  Json record = {{"format", "veldt-export"}, {"version", 1},     {"veldt_version", kVersion},
                 {"request", request},       {"splits", splits}, {"left_out", outcome.left_out}};
  if (const Json figures = outcome.outlines.json(); !figures.empty()) record["outline_iou"] = figures;
  return to_text(record);
}

bool is_empty_or_new(const Path& folder) {
  return !std::filesystem::exists(folder) ||
         (std::filesystem::is_directory(folder) && std::filesystem::is_empty(folder));
}

/// Whether a folder holds nothing but tar files of such an export, left by a killed run that copies shards one by one.
bool is_half_put(const Path& out, const ExportInput& input) {
  if (!std::filesystem::is_directory(out)) return false;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out))
    if (!entry.is_directory() && !is_shard_name(entry.path().lexically_relative(out), input)) return false;
  return true;
}

/// Whether `out` holds an export of the same request. ConfigError if it holds anything else.
bool is_there(const ExportOptions& options, const Path& out, const Json& request, const ExportInput& input) {
  if (is_empty_or_new(out)) return false;
  if (!options.scratch.empty() && is_half_put(out, input)) return false;
  if (!std::filesystem::exists(out / kRecord))
    throw ConfigError(fault("--out", out.string(), "", "an empty or new folder"));
  const Json record = read_json(out / kRecord);
  check_version(record, (out / kRecord).string(), 1);
  const std::vector<std::string> found = differences(request, record.value("request", Json::object()));
  if (found.empty()) return true;
  constexpr std::size_t kMost = 8;
  throw ConfigError(
      fmt::format("{} holds another export: {}; expected the same request, or an empty or new folder",
                  out.string(), list_names(found, kMost)));
}

/// Returns the number of pictures copied because links were impossible.
int link_pictures(const ExportPlan& plan, const LabelSet& set, const Path& folder, Linking linking,
                  const RunHooks& hooks) {
  Progress progress{.clip = "", .done = 0, .total = static_cast<int>(plan.pictures.size())};
  int copied = 0;
  for (const PlannedPicture& picture : plan.pictures) {
    if (hooks.stop_wanted()) throw Cancelled();
    const LabelImage& image = set.images[picture.image];
    if (link_file(picture_of(set, image), folder / picture.to, linking) != linking) ++copied;
    progress.clip = set.videos[image.video].name;
    ++progress.done;
    hooks.report(progress);
  }
  return copied;
}

void write_shards(const ExportPlan& plan, const LabelSet& set, ExportFolder& folder, const RunHooks& hooks) {
  const std::vector<std::size_t> first = first_labels(set);
  Progress progress{.clip = "", .done = 0, .total = static_cast<int>(set.images.size())};
  const auto begin_sample = [&](const LabelImage& image) {
    if (hooks.stop_wanted()) throw Cancelled();
    progress.clip = set.videos[image.video].name;
    ++progress.done;
    hooks.report(progress);
  };
  for (const PlannedShard& shard : plan.shards) {
    make_folder((folder.path() / shard.to).parent_path());
    write_shard(folder.path() / shard.to, shard, set, first, begin_sample);
    folder.put(shard.to);
  }
}

void write_texts(const ExportPlan& plan, ExportFolder& folder, const RunHooks& hooks) {
  for (const PlannedText& text : plan.texts) {
    if (hooks.stop_wanted()) throw Cancelled();
    make_folder((folder.path() / text.to).parent_path());
    write_file(folder.path() / text.to, std::as_bytes(std::span(text.content)));
    folder.put(text.to);
  }
}

void check_shards(const ExportOptions& options) {
  const int samples = samples_per_shard(options);
  if (samples < 1 || samples > kMostSamplesPerShard)
    throw ConfigError(fault("--samples-per-shard", std::to_string(samples), "",
                            fmt::format("1 to {}", kMostSamplesPerShard)));
  if (options.linking)
    throw ConfigError(fault("--link", linking_name(*options.linking), "",
                            "none with --format webdataset: pictures are copied into tar files"));
}

void check_segmentation(const ExportOptions& options) {
  if (!options.segmentation) return;
  const bool polygon = *options.segmentation == Segmentation::polygon;
  const auto refuse = [polygon](const std::string& rule) {
    throw ConfigError(fault("--segmentation", polygon ? "polygon" : "rle", "", rule));
  };
  if (options.format == ExportFormat::yolo && !polygon)
    refuse("polygon with --format yolo, or none for boxes");
  if (options.format == ExportFormat::yolo && options.boxes == BoxStyle::drawn)
    refuse("none with --box-style drawn: readers take boxes from the outlines");
  if (options.format != ExportFormat::yolo && options.format != ExportFormat::coco)
    refuse(fmt::format("none with --format {}: only coco and yolo have masks", format_name(options.format)));
}

/// Checks options of TIFFs, and those that exclude each other.
void check_tiffs(const ExportOptions& options) {
  if (options.format == ExportFormat::tiff) {
    if (options.linking)
      throw ConfigError(fault("--link", linking_name(*options.linking), "",
                              "none with --format tiff: pictures are written anew"));
    return;
  }
  const std::string rule =
      fmt::format("none with --format {}: only tiff has it", format_name(options.format));
  if (options.tiff_type)
    throw ConfigError(fault("--tiff-type", tiff_type_name(*options.tiff_type), "", rule));
  if (!options.origin.empty()) throw ConfigError(fault("--origin", options.origin, "", rule));
}

void check_no_shards(const ExportOptions& options) {
  const std::string rule =
      fmt::format("none with --format {}: only webdataset has tar files", format_name(options.format));
  if (options.samples_per_shard)
    throw ConfigError(fault("--samples-per-shard", std::to_string(*options.samples_per_shard), "", rule));
  if (!options.scratch.empty()) throw ConfigError(fault("--scratch", options.scratch.string(), "", rule));
}

void check_options(const ExportOptions& options) {
  if (options.format == ExportFormat::mot && !options.selection.empty())
    throw ConfigError(fault("--selection", options.selection.string(), "",
                            "none with --format mot: trackers are trained and judged on whole clips"));
  check_segmentation(options);
  check_tiffs(options);
  if (options.format == ExportFormat::webdataset)
    check_shards(options);
  else
    check_no_shards(options);
}

}  // namespace

std::string format_name(ExportFormat format) noexcept {
  constexpr std::array kNames = {"coco", "yolo", "mot", "birdsai", "webdataset", "tiff"};
  return kNames[static_cast<std::size_t>(format)];
}

ExportOutcome export_dataset(const ExportOptions& options, const RunHooks& hooks) {
  check_options(options);
  const Path out = named_folder(options.out);
  const ExportSource source = read_export_source(options);
  const Json request = request_of(options, source);
  ExportOutcome outcome = tally(source.input, options.format);
  if (options.format == ExportFormat::tiff) outcome.origin = origin_of(options);
  outcome.origin_given = !options.origin.empty();
  outcome.already_there = is_there(options, out, request, source.input);
  if (outcome.already_there) return outcome;
  SegmentMaker segments(source.input.set, options.segmentation.value_or(Segmentation::rle));
  ExportPlan plan = make_plan(options, source, options.segmentation ? &segments : nullptr);
  outcome.outlines = segments.figures();
  plan.texts.push_back({.to = kRecord, .content = record_of(request, outcome)});
  check_targets(plan, source.input.set);
  ExportFolder folder(out, options.scratch);
  // Whether another run has made it in the meantime.
  outcome.already_there = is_there(options, out, request, source.input);
  if (outcome.already_there) return outcome;
  if (options.format == ExportFormat::tiff)
    outcome.without_pose =
        write_tiffs(plan, source.input, options, *outcome.origin, source.coco, folder, hooks);
  else
    outcome.copied =
        link_pictures(plan, source.input.set, folder.path(), options.linking.value_or(Linking::hard), hooks);
  write_shards(plan, source.input.set, folder, hooks);
  write_texts(plan, folder, hooks);  // the record last
  folder.finish();
  return outcome;
}

}  // namespace thermal
