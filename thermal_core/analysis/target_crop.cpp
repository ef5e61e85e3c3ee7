#include "analysis/target_crop.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "base/order_statistics.h"
#include "base/parallel.h"
#include "base/text.h"
#include "dataset/label_source.h"
#include "io/image/pictures.h"

namespace thermal {
namespace {

/// Half-open pixel ranges: from `left` to before `right`.
struct Window {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;

  [[nodiscard]] int width() const noexcept { return right - left; }
  [[nodiscard]] int height() const noexcept { return bottom - top; }
  [[nodiscard]] bool holds(int x, int y) const noexcept {
    return x >= left && x < right && y >= top && y < bottom;
  }
};

/// The pixels that a box touches, and `grow_px` more on each side, in the frame.
Window window_of(const Plane<float>& frame, const LabelBox& box, int grow_px) {
  const auto inside = [](double place, int most) {
    return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(most)));
  };
  return {inside(std::floor(box.x_px) - grow_px, frame.width_px()),
          inside(std::floor(box.y_px) - grow_px, frame.height_px()),
          inside(std::ceil(box.x_px + box.width_px) + grow_px, frame.width_px()),
          inside(std::ceil(box.y_px + box.height_px) + grow_px, frame.height_px())};
}

template <typename Take>
void for_pixels(const Plane<float>& frame, const Window& window, const Take& take) {
  for (int y = window.top; y < window.bottom; ++y) {
    for (int x = window.left; x < window.right; ++x) take(x, y, static_cast<double>(frame.at(x, y)));
  }
}

double entropy_of(const std::vector<double>& levels) {
  std::array<double, 32> counts{};
  for (const double level : levels) counts[static_cast<std::size_t>(std::clamp(level, 0.0, 255.0) / 8)] += 1;
  double bits = 0;
  for (const double count : counts) {
    const double share = count / static_cast<double>(levels.size());
    if (count > 0) bits -= share * std::log2(share);
  }
  return bits;
}

double white_share_of(const std::vector<double>& levels) {
  constexpr double kWhite = 251.5;
  const auto white = std::ranges::count_if(levels, [](double level) { return level >= kWhite; });
  return static_cast<double>(white) / static_cast<double>(levels.size());
}

double gradient_variance_of(const Plane<float>& frame, const Window& window) {
  const auto at = [&frame](int x, int y) {
    return static_cast<double>(
        frame.at(std::clamp(x, 0, frame.width_px() - 1), std::clamp(y, 0, frame.height_px() - 1)));
  };
  std::vector<double> steepness;
  for_pixels(frame, window, [&](int x, int y, double) {
    steepness.push_back(0.5 * std::hypot(at(x + 1, y) - at(x - 1, y), at(x, y + 1) - at(x, y - 1)));
  });
  const double deviation = deviation_of(steepness);
  return deviation * deviation;
}

/// Bounding box of a connected part of a mask.
cv::Rect bounds_of(const cv::Mat& statistics, int part) {
  return {statistics.at<int>(part, cv::CC_STAT_LEFT), statistics.at<int>(part, cv::CC_STAT_TOP),
          statistics.at<int>(part, cv::CC_STAT_WIDTH), statistics.at<int>(part, cv::CC_STAT_HEIGHT)};
}

/// Bounding box of the part of a mask with most pixels in the box; empty if none has any.
std::optional<cv::Rect> blob_in(const cv::Mat& mask, const Window& grown, const Window& inner) {
  cv::Mat parts;
  cv::Mat statistics;
  cv::Mat centres;
  const int count = cv::connectedComponentsWithStats(mask, parts, statistics, centres, 8);
  std::vector<int> inside(static_cast<std::size_t>(count));
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (inner.holds(grown.left + x, grown.top + y)) ++inside[static_cast<std::size_t>(parts.at<int>(y, x))];
    }
  }
  inside[0] = 0;  // what is below the threshold
  const auto most = std::max_element(inside.begin(), inside.end());
  if (*most == 0) return {};
  return bounds_of(statistics, static_cast<int>(most - inside.begin()));
}

std::optional<BoxMargins> margins_of(const Plane<float>& frame, const LabelBox& box, double threshold) {
  const Window grown = window_of(frame, box, kRingPx);
  cv::Mat mask(grown.height(), grown.width(), CV_8U);
  for_pixels(frame, grown, [&](int x, int y, double level) {
    mask.at<std::uint8_t>(y - grown.top, x - grown.left) = level > threshold ? 1 : 0;
  });
  const auto blob = blob_in(mask, grown, window_of(frame, box, 0));
  if (!blob || blob->x == 0 || blob->y == 0 || blob->br().x == mask.cols || blob->br().y == mask.rows)
    return {};
  const double left = grown.left + blob->x;
  const double top = grown.top + blob->y;
  return BoxMargins{.left_px = left - box.x_px,
                    .right_px = box.x_px + box.width_px - left - blob->width,
                    .top_px = top - box.y_px,
                    .bottom_px = box.y_px + box.height_px - top - blob->height,
                    .blob_width_px = static_cast<double>(blob->width),
                    .blob_height_px = static_cast<double>(blob->height)};
}

}  // namespace

std::optional<TargetCrop> target_crop(const Plane<float>& frame, const LabelBox& box) {
  constexpr int kLeastPx = 3;
  constexpr double kLeastContrast = 3;  // deviations of the ring; estimate
  const Window inner = window_of(frame, box, 0);
  if (inner.width() < kLeastPx || inner.height() < kLeastPx) return {};
  std::vector<double> within;
  std::vector<double> ring;
  for_pixels(frame, window_of(frame, box, kRingPx),
             [&](int x, int y, double level) { (inner.holds(x, y) ? within : ring).push_back(level); });
  if (ring.empty()) return {};
  TargetCrop crop = {.box = box,
                     .contrast = quantile_of(within, 0.95) - mean_of(ring),
                     .ring_deviation = deviation_of(ring),
                     .gradient_variance = gradient_variance_of(frame, inner),
                     .entropy_bits = entropy_of(within),
                     .white_share = white_share_of(within)};
  if (crop.contrast > 0 && crop.contrast >= kLeastContrast * crop.ring_deviation)
    crop.margins = margins_of(frame, box, mean_of(ring) + 0.5 * crop.contrast);
  return crop;
}

namespace {

constexpr std::size_t kMostPictures = 1000;
constexpr std::size_t kLeastBoxes = 20;

/// Labels that are not ignored, by picture; pictures without any are left out.
std::vector<std::vector<const Label*>> labels_by_picture(const LabelSet& set) {
  std::vector<std::vector<const Label*>> pictures(set.images.size());
  for (const Label& label : set.labels)
    if (!label.crowd && !label.ignore) pictures[label.image].push_back(&label);
  std::erase_if(pictures, [](const auto& labels) { return labels.empty(); });
  std::vector<std::vector<const Label*>> taken;
  for (const std::size_t k : evenly(pictures.size(), kMostPictures)) taken.push_back(std::move(pictures[k]));
  return taken;
}

void check_is_there(const LabelSet& set, const LabelImage& image, const Path& labels) {
  if (!std::filesystem::exists(Path(set.root) / image.file))
    throw DataError(
        fmt::format("{}: no picture {} in {}; expected the folder of its pictures as --like-frames",
                    labels.string(), image.file, set.root.empty() ? "." : set.root));
}

Plane<float> levels_in(const LabelSet& set, const LabelImage& image) {
  const GreyPicture picture = read_grey_picture(picture_of(set, image));
  Plane<float> levels(picture.levels.width_px(), picture.levels.height_px());
  std::ranges::copy(picture.levels.pixels(), levels.pixels().begin());
  return levels;
}

/// Empty if the target does not differ from its surroundings.
std::optional<BoxFill> fill_of(const Plane<float>& levels, const LabelBox& box) {
  constexpr double kLeastDeviations = 4;
  const auto crop = target_crop(levels, box);
  if (!crop || !crop->margins || crop->contrast < kLeastDeviations * crop->ring_deviation) return {};
  return BoxFill{std::min(1.0, crop->margins->blob_width_px / box.width_px),
                 std::min(1.0, crop->margins->blob_height_px / box.height_px)};
}

BoxFill median_fill(const std::vector<BoxFill>& fills) {
  std::vector<double> widths;
  std::vector<double> heights;
  for (const BoxFill& fill : fills) {
    widths.push_back(fill.width);
    heights.push_back(fill.height);
  }
  return {median_of(widths), median_of(heights)};
}

}  // namespace

MeasuredFills measure_drawn_fills(const Path& labels, const Path& frames) {
  LabelSet set = read_labels(labels);
  if (!frames.empty()) set.root = frames.string();
  const auto pictures = labels_by_picture(set);
  for (const auto& picture : pictures) check_is_there(set, set.images[picture.front()->image], labels);
  std::vector<std::vector<std::optional<BoxFill>>> found(pictures.size());
  parallel_for(pictures.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Plane<float> levels = levels_in(set, set.images[pictures[k].front()->image]);
      for (const Label* label : pictures[k]) found[k].push_back(fill_of(levels, label->box));
    }
  });
  MeasuredFills measured;
  std::vector<BoxFill> all;
  std::array<std::vector<BoxFill>, 3> of_kind;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    for (std::size_t i = 0; i < pictures[k].size(); ++i) {
      const std::string& category = set.categories[pictures[k][i]->category].name;
      const auto kind = static_cast<std::size_t>(kind_of(lower_case(category)));
      ++measured.kinds.at(kind).boxes;
      if (!found[k][i]) continue;
      ++measured.kinds.at(kind).measured;
      of_kind.at(kind).push_back(*found[k][i]);
      all.push_back(*found[k][i]);
    }
  }
  if (all.size() < kLeastBoxes)
    throw DataError(fault(labels.string(), fmt::format("{} boxes whose targets stand out", all.size()), "",
                          fmt::format("at least {}", kLeastBoxes)));
  const auto fill = [&](Kind kind) {
    const auto& own = of_kind.at(static_cast<std::size_t>(kind));
    return median_fill(own.size() < kLeastBoxes ? all : own);
  };
  measured.fills = {fill(Kind::human), fill(Kind::animal), fill(Kind::vehicle)};
  return measured;
}

}  // namespace thermal
