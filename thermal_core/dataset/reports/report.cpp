#include "dataset/reports/report.h"

#include <utility>

#include "base/error.h"
#include "dataset/dataset_file.h"
#include "dataset/label_source.h"
#include "dataset/layout.h"
#include "dataset/reports/days.h"
#include "dataset/reports/flights.h"
#include "dataset/reports/frames.h"
#include "dataset/reports/labels.h"
#include "io/html_page.h"

namespace thermal {
namespace {

Path default_out(const Path& source) {
  return std::filesystem::is_directory(source) ? source / "report.html"
                                               : source.parent_path() / "report.html";
}

std::vector<FlightTrack> tracks_of(const ReportRequest& request, const Json& record) {
  const Layout layout{request.source};
  const Json& clips = record.at("clips");
  std::vector<FlightTrack> tracks;
  Progress progress = {.clip = "", .done = 0, .total = static_cast<int>(clips.size())};
  for (const Json& clip : clips) {
    progress.clip = clip.at("id");
    if (clip.at("status") == "done")
      tracks.push_back(read_track(layout.clip(progress.clip) / "frames.jsonl", progress.clip));
    ++progress.done;
    if (request.show) request.show(progress);
  }
  return tracks;
}

/// Figures that only Veldt datasets have; `record` is the dataset.json.
void add_dataset(const ReportRequest& request, Json& figures) {
  Json record = read_dataset_file(request.source);
  try {
    figures["flights"] = flight_figures(tracks_of(request, record), record.at("config"), request.assets);
    figures["days"] = day_figures(record.at("config"), request.assets);
  } catch (const Json::exception& error) {
    throw DataError(Layout{request.source}.dataset_json().string() + ": " + error.what());
  }
  figures["record"] = std::move(record);
}

}  // namespace

ReportOutcome write_report(const ReportRequest& request) {
  const LabelSet set = read_labels(request.source, request.unfinished_too);
  const bool ours = Layout{request.source}.is_begun();
  Json figures = {{"format", "veldt-report"},
                  {"version", 1},
                  {"name", set.name},
                  {"labels", label_figures(set)},
                  {"samples", sample_figures(set, ours)}};
  if (ours) add_dataset(request, figures);
  const std::string page =
      html_page(figures,
                {.title = set.name,
                 .kind = "Veldt report",
                 .scripts = {"elements.js", "charts.js", "pictures.js", "sections.js", "page.js"}},
                request.assets);
  const Path out = request.out.empty() ? default_out(request.source) : request.out;
  write_file_atomically(out, page);
  return {.out = out,
          .clips = set.videos.size(),
          .images = set.images.size(),
          .labels = set.labels.size(),
          .bytes = page.size()};
}

}  // namespace thermal
