#include "dataset/videos/video.h"

#include <chrono>
#include <memory>

#include <fmt/format.h>

#include "base/text.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "dataset/videos/palette.h"
#include "io/assets.h"

namespace veldt {
namespace {

struct VideoArguments {
  std::string source;
  std::string beside;
  std::string out;
  std::vector<std::string> clips;
  std::string palette = "white_hot";
  std::string range;
  int frame = 0;
  int width_px = 0;
  bool boxes = false;
  bool tracks = false;
  bool scale = false;
};

thermal::VideoRequest request_of(const VideoArguments& options, bool frame_given) {
  thermal::VideoRequest request{.source = options.source,
                                .beside = options.beside,
                                .out = options.out,
                                .clips = options.clips,
                                .palette = options.palette,
                                .boxes = options.boxes,
                                .tracks = options.tracks,
                                .scale = options.scale,
                                .range = std::nullopt,
                                .frame = std::nullopt,
                                .width_px = options.width_px,
                                .assets = thermal::Assets::find()};
  if (!options.range.empty()) request.range = thermal::parse_kelvin_range(options.range);
  if (frame_given) request.frame = options.frame;
  return request;
}

void summarise(const thermal::VideoOutcome& outcome, const std::string& out, double elapsed_s) {
  print("{}: {} {}, {} x {} px, ", out, outcome.clips, outcome.clips == 1 ? "clip" : "clips",
        outcome.width_px, outcome.height_px);
  if (outcome.seconds > 0)
    print("{} frames, {:.1f} s, {:.1f} frames/s, ", outcome.frames, outcome.seconds,
          outcome.frames / elapsed_s);
  print("{} kB\n", (outcome.bytes + 999) / 1000);
  if (!outcome.not_made.empty())
    print("left out, because not made: {}\n", thermal::list_names(outcome.not_made, 8));
}

int run_video(const VideoArguments& options, bool frame_given, const CommonOptions& common) {
  const thermal::VideoRequest request = request_of(options, frame_given);
  watch_for_stop();
  const auto begun = std::chrono::steady_clock::now();
  thermal::VideoOutcome outcome;
  {
    ProgressBar bar(common);
    outcome = thermal::make_video(request, hooks_for(bar));
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begun;
  if (!common.quiet) summarise(outcome, options.out, elapsed.count());
  return kDone;
}

}  // namespace

void add_video(Parser& parser) {
  Command command = parser.add_command(
      "video",
      "A video to show: false colours, a scale in kelvin, boxes and tracks; several clips in a grid");
  command.footer(
      "Example: veldt video my_dataset --out my_dataset.mp4 --palette ironbow --boxes --tracks --scale");
  auto options = std::make_shared<VideoArguments>();
  command.add_option("dataset", options->source, "A dataset, or one clip's folder in it (DIR/clips/CLIP)")
      .required()
      .type_name("DATASET|CLIP");
  command
      .add_option("--out", options->out,
                  "A video (.mp4), or a picture of one frame (.png, .jpg); a file of that name is replaced")
      .required()
      .type_name("FILE");
  command.add_option("--clips", options->clips, "Clips to show, at most 16; all that are made if not given")
      .comma_separated()
      .type_name("ID,…");
  command.add_option("--palette", options->palette, "Colours from cold to hot")
      .type_name(fmt::format("NAME:{{{}}}", fmt::join(thermal::palette_names(), ",")))
      .shows_default();
  command.add_flag("--boxes", options->boxes, "Draw labels: boxes, categories and track ids");
  command.add_flag("--tracks", options->tracks, "Draw where targets were in the last 5 seconds");
  command.add_flag("--scale", options->scale, "Draw a bar of apparent temperatures in kelvin");
  command
      .add_option("--range", options->range,
                  "Show these temperatures in K on a fixed scale, instead of the camera's gain control")
      .type_name("LO:HI");
  command
      .add_option("--side-by-side", options->beside,
                  "Show the same clips of another dataset beside, on a scale of their own")
      .type_name("DATASET2");
  const Option frame =
      command
          .add_option("--frame", options->frame, "Which frame a picture shows, from 0; else the middle one")
          .type_name("N");
  command
      .add_option("--width-px", options->width_px,
                  "Width of the whole; 0: 1280 for one column of clips, else 1920")
      .between(0, 8192)
      .shows_default();
  command.runs([options, frame](const CommonOptions& common) {
    return run_video(*options, frame.is_given(), common);
  });
}

}  // namespace veldt
