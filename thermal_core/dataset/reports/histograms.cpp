#include "dataset/reports/histograms.h"

#include <algorithm>
#include <cmath>

#include "base/nearest_rank.h"

namespace thermal {
namespace {

/// The largest of 1, 2, 5, 10, 20 … and 0.1, 0.2, 0.5 … that is at most `width`.
double round_width(double width) {
  const double power = std::pow(10.0, std::floor(std::log10(width)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= width * (1 + 1e-9)) return factor * power;
  }
  return power;
}

/// Nearly equal values get fewer bins, so that edges remain distinct numbers.
std::vector<double> linear_edges(double low, double high) {
  constexpr double kBins = 15;      // at least, and fewer than 40
  constexpr double kFinest = 1e-9;  // least bin width, as a share of the larger value or of 1
  const double finest = kFinest * std::max({1.0, std::abs(low), std::abs(high)});
  const double step = high > low ? round_width(std::max(high / kBins - low / kBins, finest))
                                 : round_width(std::max(1e-3, 0.1 * std::abs(low)));
  const auto first = std::floor(low / step);
  const auto last = std::max(first + 1, std::ceil(high / step));
  std::vector<double> edges;
  for (double k = first; k <= last; ++k) edges.push_back(k * step);
  return edges;
}

std::vector<double> logarithmic_edges(double low, double high) {
  constexpr double kToADecade = 5;
  constexpr double kLeast = 0.01;
  std::vector<double> edges;
  const double first = std::floor(kToADecade * std::log10(std::max(low, kLeast)));
  const double last = std::floor(kToADecade * std::log10(std::max(high, kLeast))) + 1;
  for (double k = first; k <= last; ++k) edges.push_back(std::pow(10.0, k / kToADecade));
  return edges;
}

std::size_t bin_of(double value, const std::vector<double>& edges) {
  const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, value);
  return static_cast<std::size_t>(above - edges.begin() - 1);
}

std::vector<double> known_values(const std::vector<HistogramValue>& values) {
  std::vector<double> known;
  for (const HistogramValue& entry : values) {
    if (entry.value) known.push_back(*entry.value);
  }
  std::sort(known.begin(), known.end());
  return known;
}

}  // namespace

std::vector<double> bin_edges(std::vector<double> values, Bins bins) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  constexpr double kTail = 0.005;
  const double low = nearest_rank(values, kTail);
  const double high = nearest_rank(values, 1 - kTail);
  if (bins == Bins::logarithmic) return logarithmic_edges(low, high);
  if (bins == Bins::linear) return linear_edges(low, high);
  std::vector<double> edges;
  for (int k = 0; k <= 20; ++k) edges.push_back(k / 20.0);
  return edges;
}

Json histogram_of(const std::vector<HistogramValue>& values, std::size_t categories, Bins bins) {
  const std::vector<double> known = known_values(values);
  Json json = {{"known", known.size()}, {"of", values.size()}};
  if (known.empty()) return json;
  const std::vector<double> edges = bin_edges(known, bins);
  std::vector<std::vector<int>> counts(categories, std::vector<int>(edges.size() - 1));
  for (const HistogramValue& entry : values) {
    if (entry.value) ++counts[entry.category][bin_of(*entry.value, edges)];
  }
  json["least"] = known.front();
  json["median"] = nearest_rank(known, 0.5);
  json["most"] = known.back();
  json["below"] = std::lower_bound(known.begin(), known.end(), edges.front()) - known.begin();
  json["above"] = known.end() - std::upper_bound(known.begin(), known.end(), edges.back());
  json["edges"] = edges;
  json["counts"] = counts;
  return json;
}

}  // namespace thermal
