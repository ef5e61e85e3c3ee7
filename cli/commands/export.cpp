#include "dataset/exports/export.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <numeric>

#include <fmt/format.h>

#include "analysis/target_crop.h"
#include "base/error.h"
#include "base/text.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/progress_bar.h"

namespace veldt {
namespace {

struct ExportArguments {
  thermal::ExportOptions what;
  std::string source;
  std::string format;
  std::string out;
  std::string link;
  std::string images;
  std::string segmentation;
  std::string tiff_type;
  std::string split;
  std::string selection;
  std::string scratch;
  std::string like;
  std::string like_frames;
};

thermal::ExportFormat format_named(const std::string& name) {
  using Format = thermal::ExportFormat;
  for (const Format format : {Format::coco, Format::yolo, Format::mot, Format::birdsai, Format::tiff})
    if (name == thermal::format_name(format)) return format;
  return Format::webdataset;
}

thermal::Linking linking_named(const std::string& name) {
  if (name == "copy") return thermal::Linking::copy;
  return name == "hard" ? thermal::Linking::hard : thermal::Linking::symlink;
}

/// Measures the drawn boxes of other labels, and prints the result.
thermal::DrawnFills fills_like(const ExportArguments& options, const CommonOptions& common) {
  const std::vector<std::string> names = {"hit_uav", "birdsai"};
  if (const auto named = thermal::drawn_fills_named(options.like)) {
    if (!options.like_frames.empty())
      throw thermal::ConfigError(
          thermal::fault("--like-frames", options.like_frames, "", "none with a named style"));
    return *named;
  }
  if (!std::filesystem::exists(options.like))
    throw thermal::ConfigError(thermal::fault(
        "--like", options.like, "",
        "hit_uav, birdsai or labels of your own" + thermal::did_you_mean(options.like, names)));
  const thermal::MeasuredFills found = thermal::measure_drawn_fills(options.like, options.like_frames);
  if (common.quiet) return found.fills;
  for (const auto& [kind, name] : {std::pair{thermal::Kind::human, "people"},
                                   {thermal::Kind::animal, "animals"},
                                   {thermal::Kind::vehicle, "vehicles"}}) {
    const thermal::MeasuredBoxes& boxes = found.kinds.at(static_cast<std::size_t>(kind));
    const thermal::BoxFill& fill = found.fills.of(kind);
    if (boxes.boxes > 0)
      print("{}: {} fill {:.3f} x {:.3f} of their boxes ({} of {} boxes measured)\n", options.like, name,
            fill.width, fill.height, boxes.measured, boxes.boxes);
  }
  return found.fills;
}

thermal::ExportOptions request_of(const ExportArguments& options, const CommonOptions& common) {
  thermal::ExportOptions request = options.what;
  request.source = options.source;
  request.format = format_named(options.format);
  request.out = options.out;
  if (!options.link.empty()) request.linking = linking_named(options.link);
  request.ir16 = options.images == "ir16";
  if (request.format == thermal::ExportFormat::tiff && options.images == "ir8")
    throw thermal::ConfigError(
        thermal::fault("--images", "ir8", "", "ir16 with --format tiff, which is in kelvin"));
  if (!options.segmentation.empty())
    request.segmentation =
        options.segmentation == "rle" ? thermal::Segmentation::rle : thermal::Segmentation::polygon;
  if (!options.tiff_type.empty())
    request.tiff_type =
        options.tiff_type == "uint16" ? thermal::TiffType::uint16 : thermal::TiffType::float32;
  if (!options.split.empty()) request.splits = thermal::parse_splits(options.split);
  request.selection = options.selection;
  request.scratch = options.scratch;
  if (!options.like.empty() && request.boxes != thermal::BoxStyle::drawn)
    throw thermal::ConfigError(thermal::fault("--like", options.like, "", "--box-style drawn beside it"));
  if (!options.like.empty()) request.fills = fills_like(options, common);
  return request;
}

int labels_in(const thermal::ExportedSplit& split) {
  return std::accumulate(split.labels.begin(), split.labels.end(), 0);
}

/// Columns are wide enough for their headings and for numbers of six digits.
std::size_t width_of(const std::string& heading) { return std::max<std::size_t>(heading.size(), 6) + 2; }

void print_cells(const std::vector<std::string>& headings, const std::string& first,
                 const std::vector<std::string>& cells) {
  print("  {:<12}", first);
  for (std::size_t i = 0; i < cells.size(); ++i) print("{:>{}}", cells[i], width_of(headings[i]));
  print("\n");
}

void print_table(const thermal::ExportOutcome& outcome) {
  std::vector<std::string> headings = {"clips", "pictures", "labels"};
  headings.insert(headings.end(), outcome.categories.begin(), outcome.categories.end());
  print_cells(headings, "split", headings);
  for (const thermal::ExportedSplit& split : outcome.splits) {
    std::vector<std::string> cells;
    for (const int count : {split.clips, split.pictures, labels_in(split)})
      cells.push_back(std::to_string(count));
    for (const int count : split.labels) cells.push_back(std::to_string(count));
    print_cells(headings, split.name, cells);
  }
}

std::string counted(int count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void print_outlines(const thermal::OutlineFigures& outlines) {
  using thermal::SizeClass;
  for (const SizeClass size : {SizeClass::small, SizeClass::medium, SizeClass::large}) {
    const auto& figures = outlines.of(size);
    if (figures.targets > 0)
      print("outlines of {} targets: IoU with the masks {:.4f} on average, {:.4f} at least ({})\n",
            thermal::size_class_name(size), figures.mean(), figures.least, counted(figures.targets, "label"));
  }
}

void summarise(const thermal::ExportOutcome& outcome, const ExportArguments& options) {
  if (outcome.already_there) {
    print("{}: nothing to do; this export already exists\n", options.out);
    return;
  }
  int pictures = 0;
  int labels = 0;
  for (const thermal::ExportedSplit& split : outcome.splits) {
    pictures += split.pictures;
    labels += labels_in(split);
  }
  print("{}: {} and {} as {}\n", options.out, counted(pictures, "picture"), counted(labels, "label"),
        options.format);
  print_table(outcome);
  for (const auto& [why, count] : outcome.left_out) print("left out: {} {}\n", counted(count, "label"), why);
  print_outlines(outcome.outlines);
  if (outcome.origin)
    print("origin of the scene: latitude {:g}, longitude {:g} deg, height {:g} m{}\n",
          outcome.origin->latitude_deg, outcome.origin->longitude_deg, outcome.origin->height_m,
          outcome.origin_given ? "" : "; --origin puts it elsewhere");
  if (outcome.without_pose > 0)
    print("{} without position and attitude: their frames have no pose\n",
          counted(outcome.without_pose, "picture"));
  if (outcome.copied > 0)
    print("{} copied: the file system cannot link them\n", counted(outcome.copied, "picture"));
}

int run_export(const ExportArguments& options, const CommonOptions& common) {
  const thermal::ExportOptions request = request_of(options, common);
  watch_for_stop();
  thermal::ExportOutcome outcome;
  {
    ProgressBar bar(common);
    outcome = thermal::export_dataset(request, hooks_for(bar));
  }
  if (!common.quiet) summarise(outcome, options);
  return kDone;
}

/// Adds options for pictures and masks.
void add_picture_options(Command& command, ExportArguments& options) {
  command
      .add_option("--link", options.link, "How to place pictures; copies where the file system cannot link")
      .one_of({"hard", "symlink", "copy"})
      .shows_default("hard");
  command
      .add_option("--images", options.images,
                  "8-bit pictures after gain control, or 16-bit pictures in kelvin")
      .one_of({"ir8", "ir16"})
      .shows_default("ir8");
  command
      .add_option("--segmentation", options.segmentation,
                  "Masks of --format coco as run lengths or polygons (default: as they are); polygon with "
                  "--format yolo "
                  "writes outlines instead of boxes")
      .one_of({"rle", "polygon"});
  command
      .add_option("--tiff-type", options.tiff_type,
                  "Pixels of --format tiff: kelvin, or counts with their scale in the tags")
      .one_of({"float32", "uint16"})
      .shows_default("float32");
  command
      .add_option(
          "--origin", options.what.origin,
          "Where --format tiff puts the scene's (0, 0) on Earth (WGS 84), e.g. -19.3,23.1; by default 23 deg "
          "east, on the latitude and at the height of the dataset's weather")
      .type_name("LAT,LON[,HEIGHT]");
  add_box_style(command, options.what.boxes,
                "Boxes around visible pixels, or with the margin of 1 to 2 px that people leave");
  const Option like =
      command
          .add_option("--like", options.like,
                      "Drawn boxes as people drew those of a set: hit_uav, birdsai, or labels of your own, "
                      "of which the warm target's share of each box is measured")
          .type_name("STYLE|LABELS");
  command
      .add_option("--like-frames", options.like_frames,
                  "Folder of these labels' pictures, if they are not beside the labels")
      .needs(like)
      .type_name("DIR");
}

}  // namespace

void add_export(Parser& parser) {
  Command command = parser.add_command(
      "export",
      "Write a dataset as other programs read it: COCO, YOLO, MOTChallenge, BIRDSAI, WebDataset, TIFF");
  command.footer(
      "Splits are made by clip, never by frame.\n"
      "Example: veldt export my_dataset --format yolo --out yolo --split train:0.8,val:0.2");
  auto options = std::make_shared<ExportArguments>();
  command.add_option("dataset", options->source, "A dataset, a BIRDSAI folder or a COCO file; never modified")
      .required()
      .type_name("DATASET");
  command.add_option("--format", options->format, "Layout and files to write")
      .required()
      .one_of({"coco", "yolo", "mot", "birdsai", "webdataset", "tiff"});
  command.add_option("--out", options->out, "Folder of the export, empty or new").required().type_name("DIR");
  add_picture_options(command, *options);
  const Option split = command
                           .add_option("--split", options->split,
                                       "Split by whole clips, stratified by category, e.g. train:0.8,val:0.2")
                           .type_name("NAME:SHARE,…");
  command.add_option("--seed", options->what.seed, "Seed of the splits; by default the dataset's, or 1")
      .needs(split);
  command.add_option("--selection", options->selection, "Export only the frames that veldt balance selected")
      .type_name("FILE");
  command
      .add_option("--samples-per-shard", options->what.samples_per_shard,
                  "Most pictures in a tar file of --format webdataset")
      .shows_default("1000");
  command
      .add_option("--scratch", options->scratch,
                  "Make each tar file of --format webdataset here, then copy it to --out, which may be an "
                  "object store")
      .type_name("DIR");
  command.add_flag("--unfinished", options->what.unfinished_too, "Accept a dataset with missing clips");
  command.runs([options](const CommonOptions& common) { return run_export(*options, common); });
}

}  // namespace veldt
