#include "analysis/compare/measures.h"

#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "base/order_statistics.h"

namespace thermal {
namespace {

std::string band_name(std::size_t band) {
  return fmt::format("power at {:.3g} to {:.3g} /px", kBandEdges[band], kBandEdges[band + 1]);
}

std::optional<double> logarithm(double power) {
  return power > 0 ? std::optional(std::log10(power)) : std::nullopt;
}

/// A figure of a frame or crop, and its name.
template <typename Of>
struct Figure {
  const char* name;
  const char* unit;
  std::optional<double> (*value)(const Of&);
};

constexpr std::array<Figure<FrameFigures>, 7> kGrey = {{
    {"mean", "levels", [](const FrameFigures& f) { return std::optional(f.grey.mean); }},
    {"deviation", "levels", [](const FrameFigures& f) { return std::optional(f.grey.deviation); }},
    {"1st percentile", "levels", [](const FrameFigures& f) { return std::optional(f.grey.low); }},
    {"99th percentile", "levels", [](const FrameFigures& f) { return std::optional(f.grey.high); }},
    {"dynamic range", "levels", [](const FrameFigures& f) { return std::optional(f.grey.range()); }},
    {"empty levels of the histogram", "",
     [](const FrameFigures& f) { return std::optional(f.grey.empty_share); }},
    {"roughness of histogram", "", [](const FrameFigures& f) { return std::optional(f.grey.roughness); }},
}};

template <double Edge::*Halo>
std::optional<double> median_halo(const FrameFigures& frame) {
  std::vector<double> halos;
  for (const Edge& edge : frame.edges) halos.push_back(edge.*Halo);
  return halos.empty() ? std::nullopt : std::optional(median_of(std::move(halos)));
}

/// Power at the scale of people over that of larger structures.
std::optional<double> fine_over_coarse(const FrameFigures& frame) {
  const double fine = frame.power.bands[4];  // of kBandEdges: .08 to .16, and .02 to .04
  const double coarse = frame.power.bands[2];
  return coarse > 0 ? logarithm(fine / coarse) : std::nullopt;
}

std::optional<double> noise_deviation(const FrameFigures& frame) {
  return frame.noise ? std::optional(frame.noise->deviation) : std::nullopt;
}

template <std::optional<double> FlatNoise::*Correlation>
std::optional<double> noise_correlation(const FrameFigures& frame) {
  return frame.noise ? (*frame.noise).*Correlation : std::nullopt;
}

constexpr std::array<Figure<FrameFigures>, 2> kHalos = {{
    {"undershoot before edges", "of the step", median_halo<&Edge::undershoot>},
    {"overshoot after edges", "of the step", median_halo<&Edge::overshoot>},
}};

constexpr std::array<Figure<FrameFigures>, 3> kNoise = {{
    {"in flat blocks", "levels", noise_deviation},
    {"correlation along rows", "", noise_correlation<&FlatNoise::along_rows>},
    {"correlation diagonally", "", noise_correlation<&FlatNoise::diagonal>},
}};

constexpr std::array<Figure<FrameFigures>, 5> kStructure = {{
    {"power at .08-.16 over .02-.04 /px", "log10", fine_over_coarse},
    {"stripes of rows", "log10", [](const FrameFigures& f) { return f.structure.stripes; }},
    {"ratio of warm to dark spots", "log10",
     [](const FrameFigures& f) { return std::optional(f.structure.spots); }},
    {"wavelet kurtosis", "", [](const FrameFigures& f) { return f.structure.tails; }},
    {"longest straight line", "px", [](const FrameFigures& f) { return std::optional(f.structure.line_px); }},
}};

std::optional<double> width_ratio(const TargetCrop& crop) {
  return crop.margins ? std::optional(crop.margins->blob_width_px / crop.box.width_px) : std::nullopt;
}

std::optional<double> height_ratio(const TargetCrop& crop) {
  return crop.margins ? std::optional(crop.margins->blob_height_px / crop.box.height_px) : std::nullopt;
}

constexpr std::array<Figure<TargetCrop>, 9> kCrop = {{
    {"box width", "px", [](const TargetCrop& c) { return std::optional(c.box.width_px); }},
    {"box height", "px", [](const TargetCrop& c) { return std::optional(c.box.height_px); }},
    {"contrast", "levels", [](const TargetCrop& c) { return std::optional(c.contrast); }},
    {"ring deviation", "levels", [](const TargetCrop& c) { return std::optional(c.ring_deviation); }},
    {"gradient variance", "", [](const TargetCrop& c) { return std::optional(c.gradient_variance); }},
    {"entropy", "bits", [](const TargetCrop& c) { return std::optional(c.entropy_bits); }},
    {"share at level 252 and above", "", [](const TargetCrop& c) { return std::optional(c.white_share); }},
    {"blob width / box width", "", width_ratio},
    {"blob height / box height", "", height_ratio},
}};

constexpr std::array<double, 3> kQuartiles = {0.25, 0.5, 0.75};

std::vector<Measure> all_measures() {
  std::vector<Measure> all;
  for (std::size_t band = 0; band < kBands; ++band) all.push_back({"spectrum", band_name(band), "log10"});
  for (const auto& figure : kGrey) all.push_back({"grey levels", figure.name, figure.unit});
  for (const char* name :
       {"width 10-90 %, lower quartile", "width 10-90 %, median", "width 10-90 %, upper quartile"})
    all.push_back({"edges", name, "px"});
  for (const auto& figure : kHalos) all.push_back({"edges", figure.name, figure.unit});
  for (const auto& figure : kNoise) all.push_back({"noise", figure.name, figure.unit});
  for (const auto& figure : kStructure) all.push_back({"structure", figure.name, figure.unit});
  for (const auto& figure : kCrop) all.push_back({"targets", figure.name, figure.unit});
  return all;
}

std::optional<double> band_of(const MeasuredFrames& frames, std::size_t band) {
  std::vector<double> powers;
  for (const FrameFigures* frame : frames) {
    if (frame->power.bands[band] > 0) powers.push_back(frame->power.bands[band]);
  }
  return logarithm(mean_of(powers));
}

std::optional<double> quantile_if_any(const std::vector<double>& values, double share) {
  return values.empty() ? std::nullopt : std::optional(quantile_of(values, share));
}

std::vector<double> widths_of(const FrameFigures& frame) {
  std::vector<double> widths;
  for (const Edge& edge : frame.edges) widths.push_back(edge.width_px);
  return widths;
}

template <typename Value>
std::optional<double> median_over(const MeasuredFrames& frames, const Value& value) {
  std::vector<double> values;
  for (const FrameFigures* frame : frames) {
    if (const auto known = value(*frame)) values.push_back(*known);
  }
  return quantile_if_any(values, 0.5);
}

std::optional<double> crop_median(const MeasuredFrames& frames, const Figure<TargetCrop>& figure) {
  std::vector<double> values;
  for (const FrameFigures* frame : frames) {
    for (const TargetCrop& crop : frame->crops) {
      if (const auto known = figure.value(crop)) values.push_back(*known);
    }
  }
  return quantile_if_any(values, 0.5);
}

/// Renumbers the units of a table from 0, without gaps.
void renumber(FeatureTable& table) {
  std::map<std::size_t, std::size_t> numbers;
  for (std::size_t& unit : table.units) unit = numbers.emplace(unit, numbers.size()).first->second;
}

KnownValues features_of(const FrameFigures& frame) {
  KnownValues row;
  for (const double power : frame.power.bands) row.push_back(logarithm(power));
  for (const auto& figure : kGrey) row.push_back(figure.value(frame));
  row.push_back(quantile_if_any(widths_of(frame), 0.5));
  for (const auto& figure : kHalos) row.push_back(figure.value(frame));
  for (const auto& figure : kNoise) row.push_back(figure.value(frame));
  for (const auto& figure : kStructure) row.push_back(figure.value(frame));
  return row;
}

}  // namespace

const std::vector<Measure>& measures() {
  static const std::vector<Measure> kAll = all_measures();
  return kAll;
}

KnownValues values_of(const MeasuredFrames& frames) {
  KnownValues values;
  for (std::size_t band = 0; band < kBands; ++band) values.push_back(band_of(frames, band));
  for (const auto& figure : kGrey) values.push_back(median_over(frames, figure.value));
  std::vector<double> widths;
  for (const FrameFigures* frame : frames)
    for (const double width : widths_of(*frame)) widths.push_back(width);
  for (const double share : kQuartiles) values.push_back(quantile_if_any(widths, share));
  for (const auto& figure : kHalos) values.push_back(median_over(frames, figure.value));
  for (const auto& figure : kNoise) values.push_back(median_over(frames, figure.value));
  for (const auto& figure : kStructure) values.push_back(median_over(frames, figure.value));
  for (const auto& figure : kCrop) values.push_back(crop_median(frames, figure));
  return values;
}

const std::vector<std::string>& frame_features() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> made;
    for (std::size_t band = 0; band < kBands; ++band) made.push_back(band_name(band));
    for (const auto& figure : kGrey) made.emplace_back(figure.name);
    made.emplace_back("edge width");
    for (const auto& figure : kHalos) made.emplace_back(figure.name);
    for (const auto& figure : kNoise) made.push_back(fmt::format("noise {}", figure.name));
    for (const auto& figure : kStructure) made.emplace_back(figure.name);
    return made;
  }();
  return kNames;
}

const std::vector<std::string>& crop_features() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> made;
    for (const auto& figure : kCrop) made.emplace_back(figure.name);
    return made;
  }();
  return kNames;
}

FeatureTable frame_table(const MeasuredFrames& frames) {
  FeatureTable table;
  for (const FrameFigures* frame : frames) {
    table.rows.push_back(features_of(*frame));
    table.units.push_back(frame->unit);
  }
  renumber(table);
  return table;
}

FeatureTable crop_table(const MeasuredFrames& frames) {
  FeatureTable table;
  for (const FrameFigures* frame : frames) {
    for (const TargetCrop& crop : frame->crops) {
      KnownValues row;
      for (const auto& figure : kCrop) row.push_back(figure.value(crop));
      table.rows.push_back(std::move(row));
      table.units.push_back(frame->unit);
    }
  }
  renumber(table);
  return table;
}

}  // namespace thermal
