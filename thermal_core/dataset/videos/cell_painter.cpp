#include "dataset/videos/cell_painter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <opencv2/imgproc.hpp>

#include "base/text.h"

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

namespace {

constexpr const char* kShutterText = "shutter closed (FFC)";
constexpr double kShade = 0.62;  // opacity of the shade behind text on a picture

PixelRect padded(const PixelRect& rect, int by_px) {
  return {rect.x_px - by_px, rect.y_px - by_px, rect.width_px + 2 * by_px, rect.height_px + 2 * by_px};
}

/// Baseline that centres text in a rectangle's height.
int baseline_in(const PixelRect& rect, int capital_px) {
  return rect.y_px + (rect.height_px + capital_px) / 2;
}

cv::Mat enlarged(const Plane<std::uint8_t>& levels, const cv::Size& size) {
  cv::Mat source(levels.height_px(), levels.width_px(), CV_8UC1);
  std::copy(levels.pixels().begin(), levels.pixels().end(), source.data);
  cv::Mat result;
  // Neither overshoots, as cubic interpolation does around hot targets.
  const bool smaller = size.width < source.cols || size.height < source.rows;
  cv::resize(source, result, size, 0, 0, smaller ? cv::INTER_AREA : cv::INTER_LINEAR_EXACT);
  return result;
}

/// The palette as an OpenCV colour map.
cv::Mat colour_map(const PaletteTable& palette) {
  cv::Mat map(256, 1, CV_8UC3);
  for (int k = 0; k < 256; ++k) {
    const PaletteColour& colour = palette[static_cast<std::size_t>(k)];
    map.at<cv::Vec3b>(k, 0) = {colour[2], colour[1], colour[0]};
  }
  return map;
}

}  // namespace

CellPainter::CellPainter(const ClipFilm& film, const GridCell& cell, const CellStyle& style,
                         const FilmedDataset& dataset, Letters& letters)
    : film_(film),
      cell_(cell),
      style_(style),
      dataset_(dataset),
      letters_(letters),
      scale_(static_cast<double>(cell.picture.width_px) / film.width_px),
      line_px_(std::max(1, style.text_px / 10)),
      placer_(padded(cell.picture, -style.text_px / 4), 3 * line_px_) {
  if (style.range) levels_of_counts_ = levels_of_counts(linear_scale(*style.range), dataset.kelvin_per_count);
  if (style.tracks) trails_.emplace(film, kTrailSeconds);
}

void CellPainter::paint(std::size_t number, cv::Mat& picture) {
  const FilmFrame& frame = film_.frames[number];
  paint_caption(frame, picture);
  paint_frame(number, picture);
  if (trails_) paint_tracks(number, picture);
  if (style_.boxes) paint_boxes(number, picture);
  if (frame.shutter_closed) paint_shutter(picture);
  if (cell_.bar.width_px > 0) paint_bar(scale_of(frame), picture);
}

Plane<std::uint8_t> CellPainter::levels_of(std::size_t number) const {
  if (!style_.range) return film_.read_levels(number);
  const Plane<std::uint16_t> counts = film_.read_counts(number);
  Plane<std::uint8_t> levels(counts.width_px(), counts.height_px());
  std::ranges::transform(counts.pixels(), levels.pixels().begin(),
                         [this](std::uint16_t count) { return levels_of_counts_[count]; });
  return levels;
}

KelvinScale CellPainter::scale_of(const FilmFrame& frame) const {
  return style_.range ? linear_scale(*style_.range)
                      : scale_of_curve(frame.thresholds.value(), dataset_.kelvin_per_count);
}

void CellPainter::paint_frame(std::size_t number, cv::Mat& picture) const {
  const cv::Mat levels = enlarged(levels_of(number), {cell_.picture.width_px, cell_.picture.height_px});
  cv::Mat part = picture(to_cv(cell_.picture));
  cv::applyColorMap(levels, part, colour_map(style_.palette));
}

/// Least important last.
std::vector<std::string> CellPainter::facts_of(const FilmFrame& frame) const {
  std::vector<std::string> facts = {fmt::format("{:.1f} s", frame.time_s)};
  if (frame.agl_m) facts.push_back(fmt::format("{:.0f} m AGL", *frame.agl_m));
  facts.push_back(style_.range ? "fixed range" : "AGC " + printable(film_.agc_mode));
  const std::string& camera = dataset_.camera_of(film_.id);
  if (!camera.empty()) facts.push_back(printable(camera));
  return facts;
}

/// The clip's name on the left, and on the right as many facts as fit.
void CellPainter::paint_caption(const FilmFrame& frame, cv::Mat& picture) {
  fill(picture, cell_.caption, {kBackground, 1});
  const int size_px = style_.text_px;
  const int small_px = size_px * 9 / 10;
  const int baseline_px = baseline_in(cell_.caption, letters_.capital_px(size_px));
  const std::string name = letters_.shortened(printable(film_.id), size_px, true, cell_.picture.width_px);
  const TextPicture& heading = letters_.picture(name, size_px, true);
  write(picture, heading, {cell_.picture.x_px, baseline_px}, {kBright, 1});
  const int free_px = cell_.picture.width_px - heading.coverage.width_px() - 2 * size_px;
  std::vector<std::string> facts = facts_of(frame);
  const auto line = [&facts] { return fmt::format("{}", fmt::join(facts, "    ")); };
  while (!facts.empty() && letters_.width_px(line(), small_px) > free_px) facts.pop_back();
  const TextPicture& shown = letters_.picture(line(), small_px);
  write(picture, shown, {cell_.picture.right_px() - shown.coverage.width_px(), baseline_px}, {kDim, 1});
}

void CellPainter::paint_bar(const KelvinScale& scale, cv::Mat& picture) {
  fill(picture, cell_.bar, {kBackground, 1});
  const int label_px = style_.text_px * 9 / 10;
  const PixelRect bar{cell_.bar.x_px, cell_.bar.y_px, style_.text_px, cell_.bar.height_px};
  cv::Mat bands(256, 1, CV_8UC1);
  for (int k = 0; k < 256; ++k) bands.at<std::uint8_t>(k, 0) = static_cast<std::uint8_t>(255 - k);
  cv::Mat levels;
  cv::resize(bands, levels, {bar.width_px, bar.height_px}, 0, 0, cv::INTER_NEAREST);
  cv::Mat part = picture(to_cv(bar));
  cv::applyColorMap(levels, part, colour_map(style_.palette));
  const int half_px = letters_.capital_px(label_px) / 2;
  const double least_gap = std::min(1.0, 2.8 * label_px / bar.height_px);
  for (const ScaleTick& tick : ticks_of(scale, least_gap)) {
    const int y_px = bar.bottom_px() - 1 - static_cast<int>(std::lround(tick.position * (bar.height_px - 1)));
    fill(picture, {bar.right_px(), y_px, style_.text_px / 3, std::max(1, line_px_)}, {kDim, 1});
    const int baseline_px = std::clamp(y_px + half_px, bar.y_px + 2 * half_px, bar.bottom_px());
    write(picture, letters_.picture(tick.label, label_px), {bar.right_px() + style_.text_px / 2, baseline_px},
          {kBright, 1});
  }
  const TextPicture& title = letters_.picture("apparent temperature (K)", label_px);
  if (title.coverage.width_px() <= bar.height_px)
    write_upwards(picture, title,
                  {cell_.bar.right_px() - label_px / 4,
                   bar.bottom_px() - (bar.height_px - title.coverage.width_px()) / 2},
                  {kDim, 1});
}

PixelRect CellPainter::shown(const LabelBox& box) const {
  const auto x_px = [this](double x) {
    return cell_.picture.x_px + static_cast<int>(std::lround(x * scale_));
  };
  const double down = static_cast<double>(cell_.picture.height_px) / film_.height_px;
  const auto y_px = [&](double y) { return cell_.picture.y_px + static_cast<int>(std::lround(y * down)); };
  const int left_px = x_px(box.x_px);
  const int top_px = y_px(box.y_px);
  return {left_px, top_px, x_px(box.x_px + box.width_px) - left_px, y_px(box.y_px + box.height_px) - top_px};
}

PaletteColour CellPainter::colour_of(std::size_t category) const {
  return category_colour(film_.labels.categories[category].id);
}

std::string CellPainter::tag_of(const Label& label) const {
  const std::string name = printable(film_.labels.categories[label.category].name);
  return label.track_id ? fmt::format("{} {}", name, *label.track_id) : name;
}

PixelRect CellPainter::box_of(std::size_t number, std::int64_t track) const {
  for (std::size_t k = film_.first_label[number]; k < film_.first_label[number + 1]; ++k) {
    const Label& label = film_.labels.labels[k];
    if (label.track_id == track) return shown(label.box);
  }
  return {};
}

/// Does not cover the target itself.
void CellPainter::paint_tracks(std::size_t number, cv::Mat& picture) const {
  for (const Trail& trail : trails_->at(number)) {
    std::vector<LinePoint> points;
    for (const TrailPoint& point : trail.points)
      points.push_back({cell_.picture.x_px + point.x_px * scale_, cell_.picture.y_px + point.y_px * scale_,
                        0.15 + 0.85 * (1 - point.age_s / kTrailSeconds)});
    const PixelRect target = box_of(number, trail.track);
    draw_line(picture, cell_.picture, target, points, line_px_ + 2, {{0, 0, 0}, 0.35});
    draw_line(picture, cell_.picture, target, points, line_px_, {colour_of(trail.category), 0.9});
  }
}

void CellPainter::paint_boxes(std::size_t number, cv::Mat& picture) {
  std::vector<const Label*> tagged;
  cv::Mat part = picture(to_cv(cell_.picture));
  for (std::size_t k = film_.first_label[number]; k < film_.first_label[number + 1]; ++k) {
    const Label& label = film_.labels.labels[k];
    PixelRect box = shown(label.box);
    box.x_px -= cell_.picture.x_px;
    box.y_px -= cell_.picture.y_px;
    const double opacity = label.ignore ? 0.45 : 1;
    outline(part, padded(box, line_px_), 1, {{0, 0, 0}, 0.55 * opacity});
    outline(part, box, line_px_, {colour_of(label.category), opacity});
    if (!label.ignore) tagged.push_back(&label);
  }
  paint_tags(tagged, film_.frames[number].shutter_closed, picture);
}

void CellPainter::paint_tags(const std::vector<const Label*>& labels, bool shutter_closed, cv::Mat& picture) {
  const int size_px = std::max(11, style_.text_px * 8 / 10);
  const int pad_px = std::max(2, size_px / 4);
  std::vector<Tagged> tags;
  const Label* const first = film_.labels.labels.data();
  for (const Label* label : labels)
    tags.push_back({.box = shown(label->box),
                    .tag = {letters_.width_px(tag_of(*label), size_px) + 2 * pad_px,
                            letters_.capital_px(size_px) + 2 * pad_px + 1},
                    .track = label->track_id.value_or(first - label - 1)});  // without a track: unique
  constexpr std::int64_t kNoTrack = std::numeric_limits<std::int64_t>::min();
  if (shutter_closed) tags.push_back({.box = shutter_plate(), .tag = {0, 0}, .track = kNoTrack});
  const std::vector<TagPosition> places = placer_.place(tags);
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const PixelRect& tag = places[k].tag;
    const PixelRect& box = tags[k].box;
    const Ink ink{colour_of(labels[k]->category), 1};
    if (places[k].led) {
      const auto nearest = [](int from, int to, int value) { return std::clamp<double>(value, from, to); };
      const double x_px = nearest(box.x_px, box.right_px(), tag.x_px + tag.width_px / 2);
      const double y_px = nearest(box.y_px, box.bottom_px(), tag.y_px + tag.height_px / 2);
      draw_line(picture, cell_.picture, box,
                {{x_px, y_px, 1},
                 {nearest(tag.x_px, tag.right_px(), static_cast<int>(x_px)),
                  nearest(tag.y_px, tag.bottom_px(), static_cast<int>(y_px)), 1}},
                1, {ink.colour, 0.8});
    }
    fill(picture, tag, {{0, 0, 0}, kShade});
    write(picture, letters_.picture(tag_of(*labels[k]), size_px),
          {tag.x_px + pad_px, baseline_in(tag, letters_.capital_px(size_px))}, ink);
  }
}

PixelRect CellPainter::shutter_plate() {
  const int size_px = style_.text_px;
  const int width_px = letters_.width_px(kShutterText, size_px, true) + 2 * size_px;
  return {cell_.picture.x_px + (cell_.picture.width_px - width_px) / 2, cell_.picture.y_px + size_px,
          width_px, 2 * size_px};
}

/// The frame is an earlier one, so the current labels may not fit it.
void CellPainter::paint_shutter(cv::Mat& picture) {
  const PixelRect plate = shutter_plate();
  cv::Mat part = picture(to_cv(cell_.picture));
  fill(part,
       {plate.x_px - cell_.picture.x_px, plate.y_px - cell_.picture.y_px, plate.width_px, plate.height_px},
       {{0, 0, 0}, 0.75});
  write(picture, letters_.picture(kShutterText, style_.text_px, true),
        {plate.x_px + style_.text_px, baseline_in(plate, letters_.capital_px(style_.text_px))},
        {{255, 196, 0}, 1});
}

}  // namespace thermal
