#include "bench/heat_suite.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/parallel.h"
#include "base/rng.h"
#include "bench/bench_scene.h"
#include "bench/measure.h"
#include "imaging/scene_radiance.h"
#include "imaging/typical_heat.h"

namespace thermal {
namespace {

using Materials = std::map<std::string, MaterialHeat>;

/// Finest practical steps, within 9 mK of those twice as fine.
const HeatSteps kFinestSteps = {
    .per_day = 5760, .layers = {.first_m = 0.0005, .ratio = 1.1}, .settled_k = 1e-4};

constexpr int kMinutes = 1440;

/// Collects differences of temperatures.
class Differences {
 public:
  void add(double difference_k) {
    sum2_k_ += difference_k * difference_k;
    worst_k_ = std::max(worst_k_, std::abs(difference_k));
    ++count_;
  }
  [[nodiscard]] double rms_mk() const { return 1e3 * std::sqrt(sum2_k_ / static_cast<double>(count_)); }
  [[nodiscard]] double worst_mk() const { return 1e3 * worst_k_; }

 private:
  double sum2_k_ = 0;
  double worst_k_ = 0;
  std::size_t count_ = 0;
};

/// Days of open level pieces of a material in winter.
class Piece {
 public:
  Piece(const Materials& materials, const std::string& name)
      : heat_(materials.at(name)), soil_(std::get<GroundHeat>(materials.at("soil"))) {}

  [[nodiscard]] SurfaceDay day(const SurfaceExposure& exposure, const HeatSteps& steps) const {
    const std::vector<Forcing> forcing = forcing_of_day(weather_of(Season::winter).day, steps.per_day);
    return day_of(heat_, soil_, exposure, {.forcing = forcing}, steps);
  }

 private:
  const MaterialHeat& heat_;
  const GroundHeat& soil_;
};

std::vector<RenderRow> column_rows(const Materials& materials) {
  struct Case {
    const char* material = nullptr;
    const char* name = nullptr;
    HeatSteps steps = {};
  };
  const HeatSteps& frames = kTableSteps;
  const Case cases[] = {
      {"soil", "soil, 288 steps, layers x 1.35", {.per_day = 288, .layers = {.ratio = 1.35}}},
      {"soil", "soil, 288 steps, layers x 1.2", {.per_day = 288}},
      {"soil", "soil, 144 steps, layers x 1.2", frames},
      {"soil", "soil, 72 steps, layers x 1.2", {.per_day = 72}},
      {"soil", "soil, 576 steps, 2 mm x 1.2", {.per_day = 576, .layers = {.first_m = 0.002}}},
      {"rock", "rock, 144 steps", frames},
      {"grass", "grass, 144 steps", frames},
      {"acacia", "leaves of trees, 144 steps", frames},
      {"water", "water, 144 steps", frames},
  };
  std::vector<RenderRow> rows;
  for (const Case& one : cases) {
    const Piece piece(materials, one.material);
    const SurfaceDay exact = piece.day({}, kFinestSteps);
    const SurfaceDay day = piece.day({}, one.steps);
    Differences night;
    Differences light;
    for (int minute = 0; minute < kMinutes; ++minute) {
      const double hour = minute / 60.0;
      const bool sun = hour > 7 && hour < 18;
      (sun ? light : night).add(day.at_k(hour) - exact.at_k(hour));
    }
    const double seconds = shortest_run_s([&] { (void)piece.day({}, one.steps); }, 0.1);
    rows.push_back({.group = "day of a column, winter",
                    .name = one.name,
                    .figures = {{"us", 1e6 * seconds},
                                {"us/day", 1e6 * seconds / day.days},
                                {"night rms mK", night.rms_mk()},
                                {"worst mK", night.worst_mk()},
                                {"day rms mK", light.rms_mk()},
                                {"worst mK by day", light.worst_mk()}}});
  }
  return rows;
}

RenderRow table_row(const std::string& name, const Materials& materials) {
  const DayWeather weather = weather_of(Season::winter).day;
  std::set<std::string> names;
  for (const auto& [material, heat] : materials) names.insert(material);
  std::size_t columns = 0;
  const double seconds = shortest_run_s(
      [&] {
        const HeatOfDay day(weather, materials);
        (void)day.at(0, names);
        columns = day.columns();
      },
      0.1);
  return {.group = "tables of a day",
          .name = name,
          .figures = {{"columns", static_cast<double>(columns)},
                      {"s", seconds},
                      {"s per 2500", 2500 * seconds / static_cast<double>(columns)}}};
}

std::vector<RenderRow> table_rows(const Materials& materials) {
  const auto only = [&](const std::vector<std::string>& names) {
    Materials some = {{"soil", materials.at("soil")}};
    for (const std::string& name : names) some.emplace(name, materials.at(name));
    return some;
  };
  return {table_row("soil alone", only({})), table_row("rock and soil", only({"rock"})),
          table_row("acacia and soil", only({"acacia"})), table_row("all materials", materials)};
}

/// One of many exposures: slopes up to 35 deg, a third of them shaded, a quarter moist at random; or bodies in the open
/// that face any direction.
SurfaceExposure exposure_of(int number, bool is_body) {
  std::array<float, kRandomBatch> random{};
  fill_uniform({.seed = 7, .stream = 0, .clip = 0, .frame = static_cast<std::uint32_t>(number)}, 0, random);
  const auto share = [&random](std::size_t which) { return static_cast<double>(random.at(which)); };
  constexpr double kPi = std::numbers::pi;
  const double slope = is_body ? std::acos(2 * share(0) - 1) : 35 * kPi / 180 * share(0);
  const double aspect = 2 * kPi * share(1);
  SurfaceExposure exposure = {
      .normal = {std::sin(slope) * std::sin(aspect), std::sin(slope) * std::cos(aspect), std::cos(slope)}};
  if (is_body) return exposure;
  if (share(2) < 1.0 / 3) {
    exposure.sky_view = 0.15 + 0.85 * share(3);
    exposure.sunlit = share(4);
  }
  if (share(5) < 0.25) exposure.moisture = share(6);
  return exposure;
}

/// Tables compared with the balance solved for each exposure.
std::vector<RenderRow> look_up_rows(const Materials& materials) {
  constexpr int kPlaces = 150;
  const HeatSteps& frames = kTableSteps;
  std::vector<RenderRow> rows;
  for (const char* name : {"soil", "grass", "rock", "water"}) {
    const Materials both = {{"soil", materials.at("soil")}, {name, materials.at(name)}};
    const HeatOfDay table(weather_of(Season::winter).day, both);
    const std::vector<Forcing> forcing = forcing_of_day(table.weather(), frames.per_day);
    const auto& soil = std::get<GroundHeat>(materials.at("soil"));
    const SurfaceDay open = day_of(soil, soil, {.moisture = table.at(0).ground_moisture}, {forcing}, frames);
    const std::string_view kind = name;
    std::vector<SurfaceExposure> exposures;
    std::vector<SurfaceDay> exact;
    for (int number = 0; number < kPlaces; ++number) {
      exposures.push_back(exposure_of(number, kind == "rock"));
      if (kind == "water") exposures.back().normal = {0, 0, 1};
      exact.push_back(day_of(materials.at(name), soil, exposures.back(), {forcing, open.surface_k}, frames));
    }
    RenderRow row = {.group = "look-up against the balance", .name = name, .figures = {}};
    for (const int hour : {3, 6, 9, 12, 18}) {
      const HeatOfMoment moment = table.at(hour, {name});
      const MaterialMoment& by_exposure = moment.materials.at(name);
      Differences differences;
      for (std::size_t i = 0; i < exposures.size(); ++i)
        differences.add(by_exposure.temperature_k(exposures[i]) - exact[i].at_k(hour));
      row.figures.push_back({fmt::format("{:02}h rms mK", hour), differences.rms_mk()});
      row.figures.push_back({"worst", differences.worst_mk()});
    }
    rows.push_back(row);
  }
  return rows;
}

/// A kilometre of rolling ground with crowns every 9 m, with maps as in planning.
std::shared_ptr<const GroundMaps> maps_of_crowns() {
  constexpr std::size_t kCells = 1024;
  auto maps = std::make_shared<GroundMaps>();
  maps->size_m = kCells;
  maps->cells = kCells;
  std::vector<std::uint32_t> hours;
  for (std::size_t i = 0; i < kCells * kCells; ++i) {
    const std::size_t row = i / kCells;
    const auto x = static_cast<double>(i % kCells);
    const auto y = static_cast<double>(row);
    const double crown = std::sin(0.7 * x) * std::sin(0.7 * y);  // above 0.5: below a crown
    const bool below = crown > 0.5;
    maps->sky_view.push_back(
        static_cast<std::uint8_t>(std::lround(255 * (below ? 0.3 : 0.95 - 0.2 * crown))));
    maps->height_m.push_back(static_cast<float>(3 * std::sin(0.02 * x) + 2 * std::cos(0.03 * y)));
    maps->crown_top_m.push_back(below ? 5.0F : 0.0F);
    maps->moisture.push_back(static_cast<std::uint8_t>(std::lround(100 * (1 + std::sin(0.01 * x)) / 2)));
    hours.push_back(below ? 0x018000U : 0x03FFC0U);
  }
  maps->sunlit.push_back({weather_of(Season::winter).day.sun, std::move(hours)});
  constexpr std::size_t kFineCells = 2 * kCells;
  const std::vector<std::uint8_t> none(kFineCells * kFineCells);
  maps->covers = {.cells = kFineCells,
                  .kinds = {"soil"},
                  .kind = none,
                  .grass = std::vector<std::uint8_t>(none.size(), 128),
                  .trodden = none,
                  .ash = none,
                  .border = std::vector<std::uint8_t>(none.size(), 255)};
  return maps;
}

/// The whole chain of a frame, with temperatures by Table 1 and by the heat balance.
std::vector<RenderRow> frame_rows(const MaterialLibrary& materials) {
  const BenchScene scene = rolling_ground();
  const std::size_t bytes =
      (2 * sizeof(std::uint16_t) + 5 * sizeof(float)) * scene.passes.object_index.size();
  const double copy_s = memcpy_s(bytes);
  PhysicsSettings settings = {
      .terms = {.place = true, .facing = true, .variation = true, .parts = true, .sky = true, .path = true},
      .weather = weather_of(Season::winter)};
  double before_s = 0;
  std::vector<RenderRow> rows;
  const auto add = [&](const std::string& name) {
    const SceneRadiance chain(scene.manifest, materials, settings);
    Plane<float> plane;
    const double seconds =
        shortest_run_s([&] { chain.radiance(scene.passes, scene.manifest.frames[0], plane); });
    if (before_s == 0) before_s = seconds;
    rows.push_back({.group = "frame, 640 x 512",
                    .name = name,
                    .figures = {{"ms", 1e3 * seconds},
                                {"ms more", 1e3 * (seconds - before_s)},
                                {"x memcpy", seconds / copy_s}}});
  };
  add("Table 1 and the fractal field");
  settings.heat =
      HeatSettings{.day = std::make_shared<HeatOfDay>(settings.weather.day, heat_of_materials(materials)),
                   .ground = nullptr};
  add("heat balance without maps");
  settings.heat->ground = maps_of_crowns();
  add("heat balance with maps");
  return rows;
}

}  // namespace

std::vector<RenderRow> run_heat_suite(const MaterialLibrary& materials,
                                      const std::function<void(const std::string&)>& announce) {
  return with_threads(1, [&] {
    const Materials heat = heat_of_materials(materials);
    std::vector<RenderRow> rows;
    const auto add = [&](const std::string& what, const std::function<std::vector<RenderRow>()>& measured) {
      announce(what);
      for (RenderRow& row : measured()) rows.push_back(std::move(row));
    };
    add("days of columns", [&] { return column_rows(heat); });
    add("tables of a day", [&] { return table_rows(heat); });
    add("what tables give", [&] { return look_up_rows(heat); });
    add("frames", [&] { return frame_rows(materials); });
    return rows;
  });
}

}  // namespace thermal
