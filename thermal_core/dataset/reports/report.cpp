#include "dataset/reports/report.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error.h"
#include "dataset/dataset_file.h"
#include "dataset/label_source.h"
#include "dataset/reports/flights.h"
#include "dataset/reports/frames.h"
#include "dataset/reports/labels.h"
#include "heat/surface/heat_report.h"
#include "imaging/typical_heat.h"
#include "io/config/config.h"
#include "io/config/materials.h"
#include "io/html_page.h"
#include "io/json/file.h"

namespace thermal {
namespace {

constexpr double kStepH = 0.5;
constexpr std::size_t kMostDaysShown = 4;  // of clips with weather of their own

std::optional<DatasetSpec> spec_of(const Json& document, const Assets& assets) {
  try {
    return resolve_config(document, "config", assets).spec;
  } catch (const ConfigError&) {
    return std::nullopt;  // of another version
  }
}

template <typename TemperatureAt>
Json over_the_day(const TemperatureAt& temperature_k) {
  constexpr double kCentikelvin = 100;
  Json values = Json::array();
  for (double hour = 0; hour <= 24; hour += kStepH)
    values.push_back(std::round(kCentikelvin * temperature_k(hour)) / kCentikelvin);
  return values;
}

/// The days around the flights of a dataset, by its config, as JSON: for each season `season`, `flown_h` (from and to,
/// in local solar time), `step_h`, `air_k` and `materials_k`, temperatures of open level surfaces at 0:00, step_h, …
/// 24:00. Empty without temperatures by the heat balance, or for a config of an unsupported version.
Json day_figures(const Json& document, const Assets& assets) {
  Json days = Json::array();
  const std::optional<DatasetSpec> spec = spec_of(document, assets);
  if (!spec || !spec->physical || !spec->heat_balance) return days;
  const auto materials = heat_of_materials(read_materials(assets));
  std::vector<FlownWeather> flown = flown_weather(*spec);
  flown.resize(std::min(flown.size(), kMostDaysShown));
  for (const auto& [season, weather, flown_h] : flown) {
    const DayWeather& day = weather.day;
    Json by_material = Json::object();
    for (const HeatCurve& curve : open_curves(day, materials))
      by_material[curve.material] = over_the_day([&](double hour) { return curve.day.at_k(hour); });
    days.push_back({{"season", season_name(season)},
                    {"flown_h", flown_h},
                    {"step_h", kStepH},
                    {"air_k", over_the_day([&](double hour) { return air_temperature_k(day, hour); })},
                    {"materials_k", std::move(by_material)}});
  }
  return days;
}

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
