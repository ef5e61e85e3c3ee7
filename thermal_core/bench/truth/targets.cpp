#include "bench/truth/targets.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace thermal {
namespace {

TruthShape ellipse(double x, double y, double half_x, double half_y) {
  return {.is_ellipse = true, .x = x, .y = y, .half_x = half_x, .half_y = half_y};
}

TruthShape rectangle(double x, double y, double half_x, double half_y) {
  return {.is_ellipse = false, .x = x, .y = y, .half_x = half_x, .half_y = half_y};
}

/// Half of a shape's width at a height; negative outside.
double half_width_at(const TruthShape& shape, double y) noexcept {
  const double down = std::abs(y - shape.y) / shape.half_y;
  if (down >= 1) return -1;
  return shape.is_ellipse ? shape.half_x * std::sqrt(1 - down * down) : shape.half_x;
}

/// Half of a shape's width, integrated from its centre to a height, at most to its end.
double half_area_to(const TruthShape& shape, double y) noexcept {
  const double v = std::clamp((y - shape.y) / shape.half_y, -1.0, 1.0);
  const double unit = shape.is_ellipse ? 0.5 * (v * std::sqrt(1 - v * v) + std::asin(v)) : v;
  return unit * shape.half_x * shape.half_y;
}

/// Response to a part of the target on a line, for a pixel centred at x_px.
double of_stretch(const ContrastKernel& kernel, double x_px, const TruthStretch& stretch, int line) {
  return stretch.share *
         (kernel.up_to(x_px - stretch.begin_px, line) - kernel.up_to(x_px - stretch.end_px, line));
}

double from_lines(const ContrastKernel& kernel, const std::vector<std::vector<TruthStretch>>& lines,
                  int first_line, int x, int y) {
  const int per_px = kernel.steps().lines_per_px;
  double sum = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    // Line j is at (j + 1/2) / per_px, the pixel's centre at y + 1/2: between lines for an even per_px.
    const int line = first_line + static_cast<int>(i) - (y * per_px + per_px / 2);
    for (const TruthStretch& stretch : lines[i]) sum += of_stretch(kernel, x + 0.5, stretch, line);
  }
  return sum / per_px;
}

/// Response to a ray, per px^2, at an offset from a pixel: the kernel itself, whose rows are beside the ray's.
double of_ray(const ContrastKernel& kernel, double dx_px, double dy_px) {
  constexpr double kHalf = 1.0 / 64;  // of a short stretch instead of a point
  const double position = -dy_px * kernel.steps().lines_per_px - 0.5;
  const auto line = static_cast<int>(std::floor(position));
  const double share = position - std::floor(position);
  const TruthStretch stretch = {-kHalf, kHalf, 1};
  return ((1 - share) * of_stretch(kernel, dx_px, stretch, line) +
          share * of_stretch(kernel, dx_px, stretch, line + 1)) /
         (2 * kHalf);
}

/// Hit points of rays [px].
using Rays = std::vector<std::pair<double, double>>;

/// Hits on the target of per_px rays across a pixel.
Rays rays_on(const std::vector<TruthShape>& shapes, int per_px) {
  const TruthShape box = bounds_of(shapes);
  const auto ray = [per_px](double px) { return static_cast<int>(std::floor(px * per_px)); };
  Rays rays;
  for (int j = ray(box.y - box.half_y); j <= ray(box.y + box.half_y); ++j) {
    for (int k = ray(box.x - box.half_x); k <= ray(box.x + box.half_x); ++k) {
      const double x_px = (k + 0.5) / per_px;
      const double y_px = (j + 0.5) / per_px;
      if (is_inside(shapes, x_px, y_px)) rays.emplace_back(x_px, y_px);
    }
  }
  return rays;
}

}  // namespace

std::vector<TruthTarget> truth_targets() {
  const GreySurface warm = {292, 0.985};
  return {
      {.name = "person", .surface = warm, .shapes = {ellipse(0, 0, 0.25, 0.14)}, .walks_m_s = 1.35},
      {.name = "impala",
       .surface = {298, 0.98},
       .shapes = {ellipse(0, 0, 0.55, 0.18), ellipse(0.68, 0, 0.22, 0.07)},
       .walks_m_s = 1.0},
      {.name = "elephant",
       .surface = {290, 0.96},
       .shapes = {ellipse(0, 0, 1.7, 0.9), ellipse(1.9, 0, 0.6, 0.5), rectangle(1.7, 0, 0.12, 1.1)},
       .walks_m_s = 1.2},
      {.name = "truck", .surface = {273, 0.80}, .shapes = {rectangle(0, 0, 2.6, 0.95)}, .walks_m_s = 6},
      {.name = "fire", .surface = {1000, 0.95}, .shapes = {ellipse(0, 0, 0.3, 0.3)}},
      {.name = "1 px", .surface = warm, .shapes = {rectangle(0, 0, 0.5, 0.5)}, .in_px = true},
      {.name = "0.3 px", .surface = warm, .shapes = {rectangle(0, 0, 0.15, 0.15)}, .in_px = true},
      {.name = "edge", .surface = warm, .shapes = {rectangle(0, 0, 15, 10)}, .in_px = true},
      {.name = "bars",
       .surface = warm,
       .shapes = {rectangle(-12, 0, 3, 10), rectangle(0, 0, 3, 10), rectangle(12, 0, 3, 10)},
       .in_px = true},
  };
}

const TruthTarget& truth_target(const std::vector<TruthTarget>& targets, const std::string& name) {
  return *std::ranges::find(targets, name, &TruthTarget::name);
}

std::vector<TruthShape> placed(const TruthTarget& target, double px_per_m, double x_px, double y_px) {
  const double scale = target.in_px ? 1 : px_per_m;
  std::vector<TruthShape> shapes = target.shapes;
  for (TruthShape& shape : shapes) {
    shape.x = x_px + scale * shape.x;
    shape.y = y_px + scale * shape.y;
    shape.half_x *= scale;
    shape.half_y *= scale;
  }
  return shapes;
}

bool is_inside(const std::vector<TruthShape>& shapes, double x_px, double y_px) noexcept {
  return std::ranges::any_of(
      shapes, [&](const TruthShape& shape) { return std::abs(x_px - shape.x) < half_width_at(shape, y_px); });
}

std::vector<TruthStretch> stretches_between(const std::vector<TruthShape>& shapes, double top_px,
                                            double bottom_px) {
  std::vector<TruthStretch> parts;
  for (const TruthShape& shape : shapes) {
    const double begin = std::max(top_px, shape.y - shape.half_y);
    const double end = std::min(bottom_px, shape.y + shape.half_y);
    if (end <= begin) continue;
    const double half = (half_area_to(shape, end) - half_area_to(shape, begin)) / (end - begin);
    parts.push_back({shape.x - half, shape.x + half, (end - begin) / (bottom_px - top_px)});
  }
  std::ranges::sort(parts, {}, &TruthStretch::begin_px);
  std::vector<TruthStretch> joined;
  for (const TruthStretch& part : parts) {
    if (!joined.empty() && part.begin_px <= joined.back().end_px) {
      joined.back().end_px = std::max(joined.back().end_px, part.end_px);
      joined.back().share = std::max(joined.back().share, part.share);
    } else {
      joined.push_back(part);
    }
  }
  return joined;
}

TruthShape bounds_of(const std::vector<TruthShape>& shapes) {
  double left = shapes[0].x;
  double right = left;
  double top = shapes[0].y;
  double bottom = top;
  for (const TruthShape& shape : shapes) {
    left = std::min(left, shape.x - shape.half_x);
    right = std::max(right, shape.x + shape.half_x);
    top = std::min(top, shape.y - shape.half_y);
    bottom = std::max(bottom, shape.y + shape.half_y);
  }
  return rectangle((left + right) / 2, (top + bottom) / 2, (right - left) / 2, (bottom - top) / 2);
}

Plane<double> true_radiance(const ContrastKernel& kernel, const std::vector<TruthShape>& shapes,
                            double ground_w_m2_sr, int width_px, int height_px, int samples) {
  const Rays rays = samples > 0 ? rays_on(shapes, samples) : Rays();
  const TruthShape box = bounds_of(shapes);
  const int per_px = kernel.steps().lines_per_px;
  const auto first_line = static_cast<int>(std::floor((box.y - box.half_y) * per_px));
  const auto end_line = samples > 0 ? first_line : static_cast<int>(std::ceil((box.y + box.half_y) * per_px));
  std::vector<std::vector<TruthStretch>> lines;
  for (int j = first_line; j < end_line; ++j) {
    lines.push_back(
        stretches_between(shapes, static_cast<double>(j) / per_px, static_cast<double>(j + 1) / per_px));
  }
  Plane<double> out(width_px, height_px, ground_w_m2_sr);
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      out.at(x, y) += from_lines(kernel, lines, first_line, x, y);
      for (const auto& [x_px, y_px] : rays)
        out.at(x, y) += of_ray(kernel, x + 0.5 - x_px, y + 0.5 - y_px) / (samples * samples);
    }
  }
  return out;
}

}  // namespace thermal
