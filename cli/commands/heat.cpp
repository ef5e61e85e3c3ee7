#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "cli/command.h"
#include "cli/output.h"
#include "heat/surface/heat_report.h"
#include "imaging/typical_heat.h"
#include "io/assets.h"
#include "io/config/materials.h"
#include "io/system/text_file.h"

namespace veldt {
namespace {

/// One day of a plot, with flight hours.
struct PlottedDay {
  std::string title;
  const thermal::DayWeather* weather = nullptr;
  const thermal::HeatReport* report = nullptr;
  std::vector<std::pair<double, double>>
      flown_h;  ///< from, to; from 0 to 24, or beyond for flights over midnight
};

constexpr double kWidth = 900;
constexpr double kHeight = 420;
constexpr double kLeft = 60;
constexpr double kRight = 170;  // space for names of curves
constexpr double kTop = 40;
constexpr double kBottom = 40;

// Okabe and Ito's colours, which are distinct for any colour vision; then the same, dashed.
constexpr std::array kColours = {"#e69f00", "#0072b2", "#009e73", "#cc79a7", "#d55e00", "#56b4e9", "#999999"};

/// Pixels of one chart.
class Chart {
 public:
  Chart(const PlottedDay& day, double top) : day_(day), top_(top) {
    for (const thermal::HeatCurve& curve : day.report->curves) {
      for (const double surface_k : curve.day.surface_k) {
        low_k_ = std::min(low_k_, surface_k);
        high_k_ = std::max(high_k_, surface_k);
      }
    }
    low_k_ = 5 * std::floor((low_k_ - 1) / 5);
    high_k_ = 5 * std::ceil((high_k_ + 1) / 5);
  }

  std::string draw() {
    text(kLeft, top_ + 20, 15, "start", day_.title);
    for (const auto& [from_h, to_h] : day_.flown_h) shade(from_h, to_h);
    axes();
    std::vector<std::pair<double, double>> air;
    for (int step = 0; step <= 96; ++step) {
      const double hour = step / 4.0;
      air.emplace_back(hour, thermal::air_temperature_k(*day_.weather, hour));
    }
    line(air, "#000000", "", 2.2);
    labels_.push_back({air.back().second, "air", "#000000"});
    for (std::size_t i = 0; i < day_.report->curves.size(); ++i) curve(i);
    names();
    for (const thermal::Crossover& crossover : day_.report->crossovers) mark(crossover);
    return std::move(svg_);
  }

 private:
  struct Label {
    double at_k;
    std::string name;
    const char* colour;
  };

  [[nodiscard]] double x(double hour) const { return kLeft + (kWidth - kLeft - kRight) * hour / 24; }
  [[nodiscard]] double y(double kelvin) const {
    return top_ + kTop + (kHeight - kTop - kBottom) * (high_k_ - kelvin) / (high_k_ - low_k_);
  }

  void text(double at_x, double at_y, int size, const char* anchor, const std::string& words,
            const char* colour = "#222222") {
    svg_ += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n", at_x,
        at_y, size, anchor, colour, words);
  }

  void shade(double from_h, double to_h) {
    const double begin = from_h - 24 * std::floor(from_h / 24);
    const double end = begin + std::min(24.0, to_h - from_h);
    rectangle(begin, std::min(end, 24.0));
    if (end > 24) rectangle(0, end - 24);
  }

  /// At least three pixels wide, so that short flights are visible.
  void rectangle(double from_h, double to_h) {
    svg_ +=
        fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#f0d080\"/>\n",
                    x(from_h), y(high_k_), std::max(3.0, x(to_h) - x(from_h)), y(low_k_) - y(high_k_));
  }

  void axes() {
    for (int hour = 0; hour <= 24; hour += 3) {
      grid(x(hour), y(low_k_), x(hour), y(high_k_));
      text(x(hour), y(low_k_) + 18, 12, "middle", fmt::format("{}:00", hour));
    }
    const double step_k = high_k_ - low_k_ > 60 ? 10 : 5;
    for (double kelvin = low_k_; kelvin <= high_k_; kelvin += step_k) {
      grid(x(0), y(kelvin), x(24), y(kelvin));
      text(kLeft - 8, y(kelvin) + 4, 12, "end", fmt::format("{:.0f} K", kelvin));
    }
  }

  void grid(double x1, double y1, double x2, double y2) {
    svg_ +=
        fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#dddddd\"/>\n",
                    x1, y1, x2, y2);
  }

  void line(const std::vector<std::pair<double, double>>& points, const char* colour, const char* dash,
            double width) {
    svg_ += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{} points=\"", colour,
                        width, dash);
    for (const auto& [hour, kelvin] : points) svg_ += fmt::format("{:.1f},{:.1f} ", x(hour), y(kelvin));
    svg_ += "\"/>\n";
  }

  void curve(std::size_t number) {
    const thermal::HeatCurve& curve = day_.report->curves[number];
    const char* colour = kColours.at(number % kColours.size());
    std::vector<std::pair<double, double>> points;
    for (int step = 0; step <= 96; ++step) points.emplace_back(step / 4.0, curve.day.at_k(step / 4.0));
    line(points, colour, number < kColours.size() ? "" : " stroke-dasharray=\"6 3\"", 1.6);
    labels_.push_back({points.back().second, curve.material, colour});
  }

  /// Names at the right end of their curves, moved apart where they would overlap, and up at the chart's bottom.
  void names() {
    constexpr double kApart = 14;
    std::ranges::sort(labels_, std::greater<>(), &Label::at_k);
    std::vector<double> at_y;
    for (const Label& label : labels_)
      at_y.push_back(std::max(y(label.at_k) + 4, at_y.empty() ? 0 : at_y.back() + kApart));
    double lowest_y = y(low_k_);
    for (std::size_t i = at_y.size(); i-- > 0; lowest_y = at_y[i] - kApart)
      at_y[i] = std::min(at_y[i], lowest_y);
    for (std::size_t i = 0; i < at_y.size(); ++i)
      text(x(24) + 8, at_y[i], 12, "start", labels_[i].name, labels_[i].colour);
  }

  void mark(const thermal::Crossover& crossover) {
    if (crossover.warmer != "soil" && crossover.colder != "soil") return;
    const auto soil = std::ranges::find(day_.report->curves, "soil", &thermal::HeatCurve::material);
    svg_ += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"#ffffff\" "
        "stroke=\"#222222\"><title>{:02.0f}:{:02.0f} "
        "{} becomes warmer than {}</title></circle>\n",
        x(crossover.solar_h), y(soil->day.at_k(crossover.solar_h)), std::floor(crossover.solar_h),
        std::floor(60 * (crossover.solar_h - std::floor(crossover.solar_h))), crossover.warmer,
        crossover.colder);
  }

  const PlottedDay& day_;
  double top_;
  double low_k_ = 1e9;
  double high_k_ = 0;
  std::string svg_;
  std::vector<Label> labels_;
};

/// An SVG with a chart a day, one below the other: curves of all surfaces and of the air in kelvin over local solar
/// time, dots where open soil crosses another surface, and flight hours shaded.
std::string heat_svg(const std::vector<PlottedDay>& days) {
  const double height = kHeight * static_cast<double>(days.size());
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      kWidth, height);
  for (std::size_t i = 0; i < days.size(); ++i)
    svg += Chart(days[i], kHeight * static_cast<double>(i)).draw();
  return svg + "</svg>\n";
}

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

std::vector<SeasonHeat> heat_of(const thermal::DatasetSpec& spec, const Surfaces& surfaces) {
  std::vector<SeasonHeat> seasons;
  std::vector<thermal::FlownWeather> flown = thermal::flown_weather(spec);
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
  const thermal::DatasetSpec spec = load_config(options.config, options.settings, assets).spec;
  const Surfaces surfaces =
      choose(thermal::heat_of_materials(thermal::read_materials(assets)), options.surfaces);
  const std::vector<SeasonHeat> seasons =
      thermal::with_threads(common.threads, [&] { return heat_of(spec, surfaces); });
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
  const std::size_t days = thermal::flown_weather(spec).size();
  if (days > seasons.size()) print("\nand {} more days, of other clips\n", days - seasons.size());
  return kDone;
}

}  // namespace

void add_heat(Parser& parser) {
  Command command = parser.add_command(
      "heat", "Temperatures of every kind of surface over the day, and what they depend on");
  command.footer("Example: veldt heat configs/demo.json --surfaces soil,grass,water,acacia --plot day.svg");
  auto options = std::make_shared<HeatArguments>();
  command.add_option("config", options->config, "Config of a dataset, JSON").required();
  add_settings(command, options->settings);
  command.add_option("--surfaces", options->surfaces, "Surfaces to show; all if not given")
      .comma_separated()
      .type_name("NAME,…");
  command.add_option("--plot", options->plot, "Write the day as a chart, SVG");
  command.add_flag("--json", options->json, "Print JSON");
  command.runs([options](const CommonOptions& common) { return run_heat(*options, common); });
}

}  // namespace veldt
