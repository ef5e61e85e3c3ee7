#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "cli/command.h"
#include "cli/heat_plot.h"
#include "cli/output.h"
#include "heat/surface/heat_report.h"
#include "imaging/typical_heat.h"
#include "io/assets.h"
#include "io/config/materials.h"
#include "io/system/text_file.h"

namespace veldt {
namespace {

constexpr std::size_t kMostDays = 4;  ///< of clips with weather of their own
constexpr int kHours[] = {0, 3, 6, 9, 12, 15, 18, 21};

struct HeatArguments {
  std::string config;
  std::vector<std::string> settings;
  std::vector<std::string> surfaces;
  std::string plot;
  bool json = false;
};

/// A season of a config: weather, flight hours, and surfaces.
struct SeasonHeat {
  thermal::Season season = thermal::Season::winter;
  thermal::Weather weather;
  std::vector<std::pair<double, double>> flown_h;
  thermal::HeatReport report;
};

std::string clock_of(double hour) {
  const double of_day = hour - 24 * std::floor(hour / 24);
  const auto minutes = static_cast<int>(std::lround(60 * of_day)) % (24 * 60);
  return fmt::format("{:02}:{:02}", minutes / 60, minutes % 60);
}

std::string day_of(const thermal::SunPath& sun) {
  constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  constexpr const char* kMonths[] = {"January", "February", "March",     "April",   "May",      "June",
                                     "July",    "August",   "September", "October", "November", "December"};
  int day = std::min(sun.day_of_year, 365);
  int month = 0;
  while (day > kDays[month]) day -= kDays[month++];
  return fmt::format("{} {}", day, kMonths[month]);
}

std::string cloud_of(const thermal::DayWeather& day) {
  if (day.cloud_hourly.empty()) return fmt::format("{:g}", day.cloud_fraction);
  const auto [least, most] = std::ranges::minmax(day.cloud_hourly);
  return fmt::format("{:g} to {:g}", least, most);
}

std::string title_of(const SeasonHeat& heat) {
  const thermal::DayWeather& day = heat.weather.day;
  const double latitude_deg = day.sun.latitude_deg;
  return fmt::format(
      "{}: {}, {:g} deg {}, vapour {:.1f} hPa, wind {:g} to {:g} m/s, cloud {}, rain {:g} days ago",
      thermal::season_name(heat.season), day_of(day.sun), std::abs(latitude_deg),
      latitude_deg < 0 ? "S" : "N", day.vapour_hpa, day.night_wind_m_s, day.day_wind_m_s, cloud_of(day),
      day.rain_days_ago);
}

using Surfaces = std::map<std::string, thermal::MaterialHeat>;

/// The named surfaces; all without names.
Surfaces choose(const Surfaces& all, const std::vector<std::string>& names) {
  if (names.empty()) return all;
  Surfaces chosen;
  for (const std::string& name : names) {
    const auto found = all.find(name);
    if (found == all.end())
      throw thermal::ConfigError(
          thermal::fault("--surfaces", name, "", "surfaces that veldt heat lists without this option"));
    chosen.insert(*found);
  }
  return chosen;
}

std::vector<SeasonHeat> heat_of(const thermal::Config& config, const Surfaces& surfaces) {
  std::vector<SeasonHeat> seasons;
  std::vector<thermal::FlownWeather> flown = thermal::flown_weather(config);
  flown.resize(std::min(flown.size(), kMostDays));
  for (auto& [season, weather, flown_h] : flown) {
    seasons.push_back({.season = season,
                       .weather = weather,
                       .flown_h = std::move(flown_h),
                       .report = thermal::heat_report(weather.day, surfaces, weather.solar_h)});
  }
  return seasons;
}

void print_curves(const SeasonHeat& heat) {
  print("{:<16}", "K above air");
  for (const int hour : kHours) print("{:>8}", clock_of(hour));
  print("\n{:<16}", "air [K]");
  for (const int hour : kHours) print("{:>8.1f}", thermal::air_temperature_k(heat.weather.day, hour));
  for (const thermal::HeatCurve& curve : heat.report.curves) {
    print("\n{:<16}", curve.material);
    for (const int hour : kHours)
      print("{:>+8.1f}", curve.day.at_k(hour) - thermal::air_temperature_k(heat.weather.day, hour));
  }
  print("\n");
}

void print_inputs(const SeasonHeat& heat) {
  print("\nat {}, what each input is worth [K]\n{:<16}", clock_of(heat.weather.solar_h), "");
  for (const thermal::InputWorth& input : heat.report.inputs) print("{:>19}", input.input);
  print("{:>16}\n", "uncertainty");
  for (const thermal::HeatCurve& curve : heat.report.curves) {
    print("{:<16}", curve.material);
    for (const thermal::InputWorth& input : heat.report.inputs)
      print("{:>+19.2f}", input.change_k.at(curve.material));
    print("{:>16.2f}\n", heat.report.uncertainty_k.at(curve.material));
  }
}

void print_crossovers(const SeasonHeat& heat) {
  print("\ncrossovers with soil\n");
  for (const thermal::Crossover& crossover : heat.report.crossovers) {
    if (crossover.warmer != "soil" && crossover.colder != "soil") continue;
    print("{}  {} becomes warmer than {}\n", clock_of(crossover.solar_h), crossover.warmer, crossover.colder);
  }
}

thermal::Json to_json(const SeasonHeat& heat) {
  thermal::Json curves;
  for (const thermal::HeatCurve& curve : heat.report.curves) {
    thermal::Json hourly = thermal::Json::array();
    for (int hour = 0; hour < 24; ++hour) hourly.push_back(curve.day.at_k(hour));
    curves[curve.material] = {{"hourly_k", std::move(hourly)},
                              {"closure_w_m2", curve.day.closure_w_m2},
                              {"uncertainty_k", heat.report.uncertainty_k.at(curve.material)}};
  }
  thermal::Json crossovers = thermal::Json::array();
  for (const thermal::Crossover& crossover : heat.report.crossovers) {
    crossovers.push_back(
        {{"solar_h", crossover.solar_h}, {"warmer", crossover.warmer}, {"colder", crossover.colder}});
  }
  thermal::Json inputs;
  for (const thermal::InputWorth& input : heat.report.inputs) inputs[input.input] = input.change_k;
  thermal::Json air = thermal::Json::array();
  for (int hour = 0; hour < 24; ++hour) air.push_back(thermal::air_temperature_k(heat.weather.day, hour));
  return {{"season", thermal::season_name(heat.season)},
          {"solar_h", heat.weather.solar_h},
          {"air_hourly_k", std::move(air)},
          {"materials", std::move(curves)},
          {"crossovers", std::move(crossovers)},
          {"inputs_k", std::move(inputs)}};
}

int run_heat(const HeatArguments& options, const CommonOptions& common) {
  const thermal::Assets assets = thermal::Assets::find();
  const thermal::Config config = load_config(options.config, options.settings, assets);
  const Surfaces surfaces =
      choose(thermal::heat_of_materials(thermal::read_materials(assets)), options.surfaces);
  const std::vector<SeasonHeat> seasons =
      thermal::with_threads(common.threads, [&] { return heat_of(config, surfaces); });
  if (!options.plot.empty()) {
    std::vector<PlottedDay> days;
    for (const SeasonHeat& heat : seasons)
      days.push_back({title_of(heat), &heat.weather.day, &heat.report, heat.flown_h});
    thermal::write_file_atomically(options.plot, heat_svg(days));
  }
  if (options.json) {
    thermal::Json all = thermal::Json::array();
    for (const SeasonHeat& heat : seasons) all.push_back(to_json(heat));
    print_json({{"days", std::move(all)}});
    return kDone;
  }
  for (const SeasonHeat& heat : seasons) {
    if (&heat != &seasons.front()) print("\n");
    print("{}\n", title_of(heat));
    print_curves(heat);
    print_inputs(heat);
    print_crossovers(heat);
  }
  const std::size_t days = thermal::flown_weather(config).size();
  if (days > seasons.size()) print("\nand {} more days, of other clips\n", days - seasons.size());
  return kDone;
}

}  // namespace

void add_heat(CLI::App& app, Session& session) {
  CLI::App* command = add_command(
      app, session, "heat", "Temperatures of every kind of surface over the day, and what they depend on");
  command->footer("Example: veldt heat configs/demo.json --surfaces soil,grass,water,acacia --plot day.svg");
  auto options = std::make_shared<HeatArguments>();
  command->add_option("config", options->config, "Config of a dataset, JSON")->required();
  add_settings(command, options->settings);
  command->add_option("--surfaces", options->surfaces, "Surfaces to show; all if not given")
      ->delimiter(',')
      ->type_name("NAME,…");
  command->add_option("--plot", options->plot, "Write the day as a chart, SVG");
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([options, &session] {
    session.run = [options, &session] { return run_heat(*options, session.common); };
  });
}

}  // namespace veldt
