#include "cli/heat_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>

namespace veldt {
namespace {

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

}  // namespace

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

}  // namespace veldt
