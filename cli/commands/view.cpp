#include "dataset/view/view.h"

#include <memory>

#include "base/text.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "io/assets.h"

namespace veldt {
namespace {

struct ViewArguments {
  std::string source;
  std::string out;
  std::vector<std::string> clips;
};

void summarise(const thermal::ViewOutcome& outcome, const std::string& out) {
  print("{}: {} {}, {} {}, {} kB; open {} in a browser\n", out, outcome.clips,
        outcome.clips == 1 ? "clip" : "clips", outcome.frames, outcome.frames == 1 ? "frame" : "frames",
        (outcome.bytes + 999) / 1000, outcome.page.string());
  if (!outcome.not_made.empty())
    print("left out, because not made: {}\n", thermal::list_names(outcome.not_made, 8));
}

int run_view(const ViewArguments& options, const CommonOptions& common) {
  watch_for_stop();
  thermal::ViewOutcome outcome;
  {
    ProgressBar bar(common, "starting", "frames", kClipPatience);
    outcome = thermal::write_view({.source = options.source,
                                   .out = options.out,
                                   .clips = options.clips,
                                   .assets = thermal::Assets::find()},
                                  hooks_for(bar));
  }
  if (!common.quiet) summarise(outcome, options.out);
  return kDone;
}

}  // namespace

void add_view(Parser& parser) {
  Command command =
      parser.add_command("view",
                         "A page to look through all frames: clips, palettes, boxes, tracks, kelvin "
                         "under the cursor; needs no server");
  command.footer("Example: veldt view my_dataset --out look");
  auto options = std::make_shared<ViewArguments>();
  command.add_option("dataset", options->source, "A dataset, or one clip's folder in it (DIR/clips/CLIP)")
      .required()
      .type_name("DATASET|CLIP");
  command
      .add_option("--out", options->out,
                  "Folder of the page (index.html) and its data; an earlier page there is replaced")
      .required()
      .type_name("DIR");
  command.add_option("--clips", options->clips, "Clips to show; all that are made if not given")
      .comma_separated()
      .type_name("ID,…");
  command.runs([options](const CommonOptions& common) { return run_view(*options, common); });
}

}  // namespace veldt
