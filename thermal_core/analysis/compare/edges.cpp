#include "analysis/compare/edges.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace thermal {
namespace {

constexpr int kCellPx = 32;
constexpr int kReachPx = 10;   // across an edge
constexpr int kPlateauPx = 6;  // from here to kReachPx the sides must be level
constexpr double kAlongPx = 4.5;
constexpr int kMarginPx = 12;          // from the frame's border to an edge: reach and width of the window
constexpr double kStraight = 0.9;      // coherence of the gradients; estimate
constexpr double kLevelShare = 0.125;  // largest deviation of a side over the step; estimate
constexpr double kLeastStep = 4;       // grey levels: above residues of rounding and codecs; estimate
constexpr double kBinPx = 0.5;

struct Gradient {
  double x = 0;
  double y = 0;
};

/// Central differences, over rows or columns that Sobel's weights smooth.
Gradient gradient_at(const Plane<float>& frame, int x, int y) {
  const auto at = [&](int dx, int dy) { return static_cast<double>(frame.at(x + dx, y + dy)); };
  return {(at(1, -1) - at(-1, -1) + 2 * (at(1, 0) - at(-1, 0)) + at(1, 1) - at(-1, 1)) / 8,
          (at(-1, 1) - at(-1, -1) + 2 * (at(0, 1) - at(0, -1)) + at(1, 1) - at(1, -1)) / 8};
}

struct Steepest {
  int x = 0;
  int y = 0;
  double steepness = 0;
};

double steepness_at(const Plane<float>& frame, int x, int y) {
  const Gradient gradient = gradient_at(frame, x, y);
  return std::hypot(gradient.x, gradient.y);
}

/// Whether no neighbour is steeper: the steepest pixel of a cell may be the flank of an edge in the next cell.
bool is_peak(const Plane<float>& frame, const Steepest& peak) {
  constexpr double kRounding = 1 + 1e-6;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (steepness_at(frame, peak.x + dx, peak.y + dy) > kRounding * peak.steepness) return false;
    }
  }
  return true;
}

Steepest steepest_in(const Plane<float>& frame, int left, int top) {
  Steepest found;
  for (int y = top; y < std::min(top + kCellPx, frame.height_px() - kMarginPx); ++y) {
    for (int x = left; x < std::min(left + kCellPx, frame.width_px() - kMarginPx); ++x) {
      const double steepness = steepness_at(frame, x, y);
      if (steepness > found.steepness) found = {x, y, steepness};
    }
  }
  return found;
}

std::vector<Steepest> candidates_of(const Plane<float>& frame) {
  std::vector<Steepest> found;
  for (int top = kMarginPx; top < frame.height_px() - kMarginPx; top += kCellPx) {
    for (int left = kMarginPx; left < frame.width_px() - kMarginPx; left += kCellPx) {
      const Steepest steepest = steepest_in(frame, left, top);
      if (steepest.steepness > 0 && is_peak(frame, steepest)) found.push_back(steepest);
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Steepest& a, const Steepest& b) { return a.steepness > b.steepness; });
  return found;
}

/// The direction across an edge, towards its higher side; empty if the gradients around it vary.
std::optional<Gradient> normal_at(const Plane<float>& frame, const Steepest& peak) {
  constexpr int kHalf = 4;
  double xx = 0;
  double yy = 0;
  double xy = 0;
  for (int dy = -kHalf; dy <= kHalf; ++dy) {
    for (int dx = -kHalf; dx <= kHalf; ++dx) {
      const Gradient gradient = gradient_at(frame, peak.x + dx, peak.y + dy);
      xx += gradient.x * gradient.x;
      yy += gradient.y * gradient.y;
      xy += gradient.x * gradient.y;
    }
  }
  if (std::hypot(xx - yy, 2 * xy) < kStraight * (xx + yy)) return {};
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  const Gradient own = gradient_at(frame, peak.x, peak.y);
  const double sign = own.x * std::cos(angle) + own.y * std::sin(angle) < 0 ? -1 : 1;
  return Gradient{sign * std::cos(angle), sign * std::sin(angle)};
}

struct Sample {
  double place_px = 0;  ///< across the edge
  double level = 0;
  double count = 0;
};

/// Mean levels in bins across an edge; bins without pixels are left out.
std::vector<Sample> profile_of(const Plane<float>& frame, const Steepest& peak, const Gradient& normal) {
  std::vector<Sample> bins(static_cast<std::size_t>(2 * kReachPx / kBinPx) + 1);
  for (int dy = -kMarginPx; dy <= kMarginPx; ++dy) {
    for (int dx = -kMarginPx; dx <= kMarginPx; ++dx) {
      const double across = dx * normal.x + dy * normal.y;
      const double along = dy * normal.x - dx * normal.y;
      if (std::abs(along) > kAlongPx || std::abs(across) > kReachPx) continue;
      Sample& bin = bins[static_cast<std::size_t>(std::lround((across + kReachPx) / kBinPx))];
      bin.place_px += across;
      bin.level += static_cast<double>(frame.at(peak.x + dx, peak.y + dy));
      bin.count += 1;
    }
  }
  std::erase_if(bins, [](const Sample& bin) { return bin.count == 0; });
  for (Sample& bin : bins) bin = {bin.place_px / bin.count, bin.level / bin.count, bin.count};
  return bins;
}

struct Side {
  double level = 0;
  double deviation = 0;
};

/// @param sign  -1: the lower side, 1: the higher one
Side side_of(const std::vector<Sample>& profile, double sign) {
  double sum = 0;
  double squares = 0;
  double count = 0;
  for (const Sample& sample : profile) {
    if (sign * sample.place_px < kPlateauPx) continue;
    sum += sample.level;
    squares += sample.level * sample.level;
    count += 1;
  }
  const double level = sum / count;
  return {level, std::sqrt(std::max(0.0, squares / count - level * level))};
}

/// Levels from 0 to 1 as their log-odds, which for a Gaussian blur are nearly linear along the profile: interpolation
/// between samples a pixel apart is then accurate.
std::vector<Sample> in_log_odds(std::vector<Sample> profile, double low, double step) {
  constexpr double kLeast = 1e-3;  // values beyond the sides are noise
  for (Sample& sample : profile) {
    const double share = std::clamp((sample.level - low) / step, kLeast, 1 - kLeast);
    sample.level = std::log(share / (1 - share));
  }
  return profile;
}

/// The last sample below half of the step before it is crossed, closest to the middle.
std::optional<std::size_t> rise_in(const std::vector<Sample>& profile) {
  std::optional<std::size_t> closest;
  for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
    const bool rises = profile[k].level < 0 && profile[k + 1].level >= 0;
    if (rises && (!closest || std::abs(profile[k].place_px) < std::abs(profile[*closest].place_px)))
      closest = k;
  }
  return closest;
}

/// Position where a profile first crosses a level, followed from a sample towards lower positions (`sign` -1) or higher
/// ones (1).
std::optional<double> crossing_px(const std::vector<Sample>& profile, std::size_t from, double level,
                                  int sign) {
  for (auto at = static_cast<std::ptrdiff_t>(from); at + sign >= 0 && at + sign < std::ssize(profile);
       at += sign) {
    const Sample& here = profile[static_cast<std::size_t>(at)];
    const Sample& next = profile[static_cast<std::size_t>(at + sign)];
    if ((here.level - level) * sign > 0 || (next.level - level) * sign < 0) continue;
    const double share = (level - here.level) / (next.level - here.level);
    return here.place_px + share * (next.place_px - here.place_px);
  }
  return {};
}

/// Largest excursions of a profile from its sides, up to the middle of its rise, as shares of the step.
void find_halos(const std::vector<Sample>& profile, double low, double step, std::size_t rise, Edge& edge) {
  for (std::size_t k = 0; k < profile.size(); ++k) {
    if (std::abs(profile[k].place_px) >= kPlateauPx) continue;
    const double share = (profile[k].level - low) / step;
    if (k <= rise) edge.undershoot = std::max(edge.undershoot, -share);
    if (k > rise) edge.overshoot = std::max(edge.overshoot, share - 1);
  }
}

std::optional<Edge> edge_of(const std::vector<Sample>& profile) {
  const Side low = side_of(profile, -1);
  const Side high = side_of(profile, 1);
  const double step = high.level - low.level;
  if (step < kLeastStep || std::max(low.deviation, high.deviation) > kLevelShare * step) return {};
  const std::vector<Sample> odds = in_log_odds(profile, low.level, step);
  const auto rise = rise_in(odds);
  if (!rise) return {};
  const double nine_to_one = std::log(9.0);  // 10 and 90 %
  const auto begin = crossing_px(odds, *rise + 1, -nine_to_one, -1);
  const auto end = crossing_px(odds, *rise, nine_to_one, 1);
  if (!begin || !end || *end <= *begin) return {};
  Edge edge = {.width_px = *end - *begin};
  find_halos(profile, low.level, step, *rise, edge);
  return edge;
}

}  // namespace

std::vector<Edge> straight_edges(const Plane<float>& frame) {
  std::vector<Edge> edges;
  for (const Steepest& peak : candidates_of(frame)) {
    if (edges.size() == kMostEdges) break;
    const auto normal = normal_at(frame, peak);
    if (!normal) continue;
    if (const auto edge = edge_of(profile_of(frame, peak, *normal))) edges.push_back(*edge);
  }
  return edges;
}

}  // namespace thermal
