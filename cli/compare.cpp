#include <array>
#include <memory>

#include "analysis/compare/comparison.h"
#include "analysis/compare/comparison_json.h"
#include "analysis/compare/comparison_page.h"
#include "base/error.h"
#include "cli/box_style_option.h"
#include "cli/command.h"
#include "cli/comparison_table.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "io/assets.h"
#include "io/image/kelvin_picture.h"

namespace veldt {
namespace {

struct CompareArguments {
  std::string real;
  std::string dataset;
  std::string real_labels;
  std::string labels;
  std::string real_names;
  std::string names;
  std::string category;
  thermal::BoxStyle boxes = thermal::BoxStyle::visible;
  std::string html;
  int frames = thermal::CompareOptions().most_frames;
  bool json = false;
  bool kelvin = false;
  thermal::StoredScale real_scale = {.prefix = "--real-"};
  thermal::StoredScale scale;
};

thermal::CompareOptions request_of(const CompareArguments& options) {
  return {.real = {.source = options.real,
                   .labels = options.real_labels,
                   .names = options.real_names,
                   .names_option = "--real-names",
                   .category = options.category,
                   .kelvin = options.kelvin,
                   .scale = options.real_scale},
          .other = {.source = options.dataset,
                    .labels = options.labels,
                    .names = options.names,
                    .names_option = "--names",
                    .category = options.category,
                    .boxes = options.boxes,
                    .kelvin = options.kelvin,
                    .scale = options.scale},
          .most_frames = options.frames};
}

thermal::Comparison compared(const CompareArguments& options, const CommonOptions& common) {
  ProgressBar bar(common, "starting", "frames", kClipPatience);
  const auto hooks = hooks_for(bar);
  thermal::CompareOptions request = request_of(options);
  request.show = [&hooks](std::size_t done, std::size_t total) {
    hooks.progress({.clip = "frames", .done = static_cast<int>(done), .total = static_cast<int>(total)});
  };
  return thermal::compare(request);
}

/// Called before any frame is read, because reading them may take a while.
void check_page(const thermal::Path& file) {
  if (file.has_parent_path() && !std::filesystem::is_directory(file.parent_path()))
    throw thermal::ConfigError(thermal::fault("--html", file.string(), "", "a file in an existing folder"));
}

/// Adds --PREFIXkelvin-per-count and --PREFIXunit, which require `kelvin`.
void add_scale(CLI::App& command, CLI::Option* kelvin, thermal::StoredScale& scale,
               const std::array<const char*, 2>& help) {
  command.add_option(scale.prefix + "kelvin-per-count", scale.kelvin_per_count, help[0])
      ->needs(kelvin)
      ->check(CLI::PositiveNumber)
      ->type_name("KELVIN");
  command
      .add_option_function<std::string>(
          scale.prefix + "unit",
          [&scale](const std::string& name) {
            scale.unit =
                name == "celsius" ? thermal::TemperatureUnit::celsius : thermal::TemperatureUnit::kelvin;
          },
          help[1])
      ->needs(kelvin)
      ->check(CLI::IsMember({"kelvin", "celsius"}));
}

bool print_rejected(const thermal::SetFigures& set) {
  for (const std::string& rejected : set.rejected) print_error("rejected: {}\n", rejected);
  return !set.rejected.empty();
}

int run_compare(const CompareArguments& options, const CommonOptions& common) {
  check_page(options.html);
  const thermal::Comparison comparison = compared(options, common);
  if (options.json) {
    print_json(to_json(comparison, true));
  } else if (!common.quiet) {
    print_tables(comparison);
  }
  if (!options.html.empty())
    thermal::write_file_atomically(options.html,
                                   thermal::comparison_page(comparison, thermal::Assets::find()));
  const bool real_rejected = print_rejected(comparison.real);
  return print_rejected(comparison.other) || real_rejected ? kSomeRejected : kDone;
}

}  // namespace

void add_compare(CLI::App& app, Session& session) {
  CLI::App* command =
      add_command(app, session, "compare",
                  "How far frames are from real ones: spectra, grey levels, edges, noise, targets");
  command->footer(
      "Each source is a Veldt dataset (its ir8), or a folder of grey pictures of 8 or 16 bits (.png, .jpg,\n"
      ".jpeg, .tif, .tiff) with labels of COCO. Differences are put beside those between random halves of\n"
      "the real frames; a measure within twice those is marked. A classifier's AUC says how well frames,\n"
      "or crops of targets, can be distinguished: .5 not at all, 1 always.\n"
      "Frames may have different sizes: each is measured as it is, and power is scaled to 640 x 512 px.\n"
      "Example: veldt compare real_frames my_dataset --box-style drawn --html comparison.html");
  auto options = std::make_shared<CompareArguments>();
  command->add_option("real", options->real, "Real frames")->required();
  command->add_option("dataset", options->dataset, "Frames to compare with them")->required();
  command
      ->add_option("--real-labels", options->real_labels,
                   "Labels of a folder of real frames; by default annotations.json in it or in its parent")
      ->type_name("FILE");
  command->add_option("--labels", options->labels, "The same of the other frames")->type_name("FILE");
  command
      ->add_option("--real-names", options->real_names,
                   "What names of real frames say, such as \"{_}_{altitude_m}_{look_angle_deg}_{_}\"")
      ->type_name("PATTERN");
  command->add_option("--names", options->names, "The same of the other frames")->type_name("PATTERN");
  command->add_option("--category", options->category, "Category of the targets (default: people)")
      ->type_name("NAME");
  add_box_style(*command, options->boxes,
                "Boxes of DATASET around visible pixels, or with the margin that people leave, as in REAL");
  CLI::Option* kelvin = command->add_flag(
      "--kelvin", options->kelvin,
      "Frames are temperatures: ir16 of a dataset, TIFFs of floats or of counts with a scale, 16-bit PNGs");
  add_scale(*command, kelvin, options->real_scale,
            {"Scale of a folder's 16-bit real frames; by default their tags say it",
             "Unit of a folder's real frames; by default their tags say it, or it is kelvin"});
  add_scale(*command, kelvin, options->scale,
            {"The same scale of the other frames", "The same unit of the other frames"});
  command->add_option("--frames", options->frames, "Most frames of each source, evenly spaced")
      ->capture_default_str();
  command
      ->add_option("--html", options->html,
                   "Write a page with charts, frames and crops of targets; needs no network")
      ->type_name("FILE");
  command->add_flag("--json", options->json, "Print JSON, with the figures of each frame and target");
  command->callback([options, &session] {
    session.run = [options, &session] { return run_compare(*options, session.common); };
  });
}

}  // namespace veldt
