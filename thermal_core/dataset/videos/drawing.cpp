#include "dataset/videos/drawing.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace thermal {
namespace {

cv::Scalar scalar_of(const PaletteColour& colour) {
  return {static_cast<double>(colour[2]), static_cast<double>(colour[1]), static_cast<double>(colour[0])};
}

cv::Rect inside(const cv::Mat& picture, const cv::Rect& rect) {
  return rect & cv::Rect(0, 0, picture.cols, picture.rows);
}

constexpr double kFarthest = 20'000;  // px; OpenCV's line coordinates have 32 bits

/// Bounding rectangle in whole pixels of points and a margin.
cv::Rect around(const std::vector<LinePoint>& points, int margin_px) {
  const auto [left, right] = std::ranges::minmax(points, {}, &LinePoint::x_px);
  const auto [top, bottom] = std::ranges::minmax(points, {}, &LinePoint::y_px);
  const auto floored = [&](double px) {
    return static_cast<int>(std::floor(std::clamp(px, -kFarthest, kFarthest))) - margin_px;
  };
  const auto raised = [&](double px) {
    return static_cast<int>(std::ceil(std::clamp(px, -kFarthest, kFarthest))) + margin_px;
  };
  return {cv::Point(floored(left.x_px), floored(top.y_px)),
          cv::Point(raised(right.x_px), raised(bottom.y_px))};
}

cv::Mat mask_of(const TextPicture& text) {
  const auto& coverage = text.coverage;
  // OpenCV has no read-only view, hence the copy.
  cv::Mat mask(coverage.height_px(), coverage.width_px(), CV_8UC1);
  std::copy(coverage.pixels().begin(), coverage.pixels().end(), mask.data);
  return mask;
}

}  // namespace

const TextPicture& Letters::picture(const std::string& text, int size_px, bool bold) {
  const auto [there, fresh] = pictures_.try_emplace({size_px, bold, text});
  if (fresh) there->second = draw_text(fonts_ / (bold ? "B612-Bold.otf" : "B612-Regular.otf"), text, size_px);
  return there->second;
}

void Letters::trim() {
  constexpr std::size_t kMost = 4096;
  if (pictures_.size() >= kMost) pictures_.clear();
}

int Letters::width_px(const std::string& text, int size_px, bool bold) {
  return picture(text, size_px, bold).coverage.width_px();
}

std::string Letters::shortened(const std::string& text, int size_px, bool bold, int most_px) {
  if (text.empty() || width_px(text, size_px, bold) <= most_px) return text;
  std::string start = text;
  while (!start.empty()) {
    start.pop_back();
    if (width_px(start + "...", size_px, bold) <= most_px) return start + "...";
  }
  return {};
}

cv::Rect to_cv(const PixelRect& rect) { return {rect.x_px, rect.y_px, rect.width_px, rect.height_px}; }

void fill(cv::Mat& picture, const PixelRect& rect, const Ink& ink) {
  const cv::Rect area = inside(picture, to_cv(rect));
  if (area.empty()) return;
  cv::Mat part = picture(area);
  if (ink.opacity >= 1) {
    part.setTo(scalar_of(ink.colour));
    return;
  }
  blend(picture, cv::Mat(area.size(), CV_8UC1, cv::Scalar(255)), area.tl(), ink);
}

/// Integer arithmetic, rounded to nearest: the same on every machine.
void blend(cv::Mat& picture, const cv::Mat& mask, const cv::Point& at, const Ink& ink) {
  const cv::Rect area = inside(picture, {at.x, at.y, mask.cols, mask.rows});
  const int opacity = static_cast<int>(std::lround(256 * std::clamp(ink.opacity, 0.0, 1.0)));
  for (int y = area.y; y < area.y + area.height; ++y) {
    const auto* cover = mask.ptr<std::uint8_t>(y - at.y) + (area.x - at.x);
    auto* pixel = picture.ptr<cv::Vec3b>(y) + area.x;
    for (int x = 0; x < area.width; ++x) {
      const int share = cover[x] * opacity;  // of 255 * 256
      if (share == 0) continue;
      for (int c = 0; c < 3; ++c) {
        const int ink_level = ink.colour[static_cast<std::size_t>(2 - c)];
        const int sum = pixel[x][c] * (255 * 256 - share) + ink_level * share;
        pixel[x][c] = static_cast<std::uint8_t>((sum + 255 * 128) / (255 * 256));
      }
    }
  }
}

void write(cv::Mat& picture, const TextPicture& text, const cv::Point& at, const Ink& ink) {
  blend(picture, mask_of(text), {at.x, at.y - text.baseline_px}, ink);
}

void write_upwards(cv::Mat& picture, const TextPicture& text, const cv::Point& at, const Ink& ink) {
  cv::Mat turned;
  const cv::Mat mask = mask_of(text);
  if (mask.empty()) return;
  cv::rotate(mask, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
  blend(picture, turned, {at.x - text.baseline_px, at.y - turned.rows}, ink);
}

void outline(cv::Mat& picture, const PixelRect& rect, int width_px, const Ink& ink) {
  const int w = width_px;
  fill(picture, {rect.x_px - w, rect.y_px - w, rect.width_px + 2 * w, w}, ink);
  fill(picture, {rect.x_px - w, rect.bottom_px(), rect.width_px + 2 * w, w}, ink);
  fill(picture, {rect.x_px - w, rect.y_px, w, rect.height_px}, ink);
  fill(picture, {rect.right_px(), rect.y_px, w, rect.height_px}, ink);
}

void draw_line(cv::Mat& picture, const PixelRect& clip, const PixelRect& hole,
               const std::vector<LinePoint>& points, int width_px, const Ink& ink) {
  constexpr int kBits = 4;  // of a pixel's fractions
  if (points.size() < 2) return;
  const cv::Rect area = inside(picture, to_cv(clip)) & around(points, width_px + 1);
  if (area.empty()) return;
  cv::Mat mask = cv::Mat::zeros(area.size(), CV_8UC1);
  // OpenCV's pixel centres are at whole numbers, ours at halves.
  const auto fixed = [&](const LinePoint& point) {
    const auto one = [](double px) {
      return static_cast<int>(std::lround(std::clamp(px, -kFarthest, kFarthest) * (1 << kBits)));
    };
    return cv::Point(one(point.x_px - area.x - 0.5), one(point.y_px - area.y - 0.5));
  };
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
    cv::line(mask, fixed(points[k]), fixed(points[k + 1]), cv::Scalar(255 * points[k].opacity), width_px,
             cv::LINE_AA, kBits);
  const cv::Rect inner = to_cv(hole) & area;
  if (!inner.empty()) mask(inner - area.tl()).setTo(0);
  blend(picture, mask, area.tl(), ink);
}

}  // namespace thermal
