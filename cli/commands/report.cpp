#include "dataset/reports/report.h"

#include <memory>

#include "cli/command.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "io/assets.h"

namespace veldt {
namespace {

struct ReportArguments {
  std::string source;
  std::string out;
  bool unfinished = false;
};

thermal::ReportOutcome report(const ReportArguments& options, const CommonOptions& common) {
  ProgressBar bar(common, "starting", "clips", kClipPatience);
  return thermal::write_report({.source = options.source,
                                .out = options.out,
                                .assets = thermal::Assets::find(),
                                .unfinished_too = options.unfinished,
                                .show = hooks_for(bar).progress});
}

int run_report(const ReportArguments& options, const CommonOptions& common) {
  const thermal::ReportOutcome outcome = report(options, common);
  if (common.quiet) return kDone;
  print("{}: {} {}, {} frames, {} labels, {} kB\n", outcome.out.string(), outcome.clips,
        outcome.clips == 1 ? "clip" : "clips", outcome.images, outcome.labels, (outcome.bytes + 999) / 1000);
  return kDone;
}

}  // namespace

void add_report(Parser& parser) {
  Command command = parser.add_command(
      "report", "One HTML page about a dataset: pictures, plots, counts, provenance; needs no network");
  command.footer("Example: veldt report my_dataset --out my_dataset.html");
  auto options = std::make_shared<ReportArguments>();
  command.add_option("dataset", options->source, "A dataset, a BIRDSAI folder or a COCO file (.json)")
      .required();
  command.add_option("--out", options->out, "File of the page; by default report.html in the dataset")
      .type_name("FILE");
  command.add_flag("--unfinished", options->unfinished, "Accept a dataset with missing clips");
  command.runs([options](const CommonOptions& common) { return run_report(*options, common); });
}

}  // namespace veldt
