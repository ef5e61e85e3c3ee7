#include "dataset/reports/report.h"

#include <utility>

#include "base/error.h"
#include "dataset/dataset_file.h"
#include "dataset/label_source.h"
#include "dataset/layout.h"
#include "dataset/reports/flights.h"
#include "dataset/reports/frames.h"
#include "dataset/reports/labels.h"
#include "dataset/reports/page.h"

namespace thermal {
namespace {

Path default_out(const Path& source) {
  return std::filesystem::is_directory(source) ? source / "report.html"
                                               : source.parent_path() / "report.html";
}

std::vector<FlightTrack> tracks_of(const Layout& layout, const Json& record) {
  std::vector<FlightTrack> tracks;
  for (const Json& clip : record.at("clips")) {
    if (clip.at("status") == "done")
      tracks.push_back(read_track(layout.clip(clip.at("id")) / "frames.jsonl", clip.at("id")));
  }
  return tracks;
}

/// Figures that only Veldt datasets have; `record` is the dataset.json.
void add_dataset(const Layout& layout, const Path& home, Json& figures) {
  Json record = read_dataset_file(layout.root);
  try {
    figures["flights"] = flight_figures(tracks_of(layout, record), record.at("config"), home);
  } catch (const Json::exception& error) {
    throw DataError(layout.dataset_json().string() + ": " + error.what());
  }
  figures["record"] = std::move(record);
}

}  // namespace

ReportOutcome write_report(const ReportRequest& request) {
  const LabelSet set = read_labels(request.source, request.unfinished_too);
  const Layout layout{request.source};
  const bool ours = layout.is_begun();
  Json figures = {{"format", "veldt-report"},
                  {"version", 1},
                  {"name", set.name},
                  {"labels", label_figures(set)},
                  {"samples", sample_figures(set, ours)}};
  if (ours) add_dataset(layout, request.home, figures);
  const std::string page = report_page(figures, set.name, request.home);
  const Path out = request.out.empty() ? default_out(request.source) : request.out;
  write_file_atomically(out, page);
  return {.out = out,
          .clips = set.videos.size(),
          .images = set.images.size(),
          .labels = set.labels.size(),
          .bytes = page.size()};
}

}  // namespace thermal
