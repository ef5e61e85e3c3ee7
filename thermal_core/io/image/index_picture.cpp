#include "io/image/index_picture.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/system/files.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

/// Splits stored rows into samples.
class Pixels {
 public:
  explicit Pixels(const PngFile& file) : header_(file.header()), colours_(file.colours()) {}

  [[nodiscard]] PicturePixel at(std::span<const std::uint8_t> row, std::size_t x) const {
    if (header_.palette) return of_palette(row[x]);
    const std::size_t channels = header_.channels();
    PicturePixel pixel;
    bool is_clear = colours_.clear.has_value();
    for (std::size_t c = 0; c < (header_.colour ? 3U : 1U); ++c) {
      const std::uint16_t value = sample(row, x * channels + c);
      is_clear = is_clear && value == (*colours_.clear)[c];
      if (header_.colour) pixel.colour[c] = static_cast<std::uint8_t>(value);
      if (!header_.colour) pixel.grey = value;
    }
    pixel.alpha = header_.alpha ? sample(row, x * channels + channels - 1) : opaque();
    if (is_clear) pixel.alpha = 0;
    return pixel;
  }

 private:
  [[nodiscard]] std::uint16_t opaque() const noexcept { return header_.bit_depth == 16 ? 0xFFFF : 0xFF; }

  [[nodiscard]] std::uint16_t sample(std::span<const std::uint8_t> row, std::size_t number) const noexcept {
    if (header_.bit_depth != 16) return row[number];
    std::uint16_t value = 0;
    std::memcpy(&value, &row[2 * number], sizeof(value));
    return value;
  }

  [[nodiscard]] PicturePixel of_palette(std::size_t entry) const {
    const std::vector<Colour>& palette = colours_.palette;
    if (entry >= palette.size())
      throw DataError(fault("damaged: a pixel's colour", fmt::format("{}", entry), "",
                            fmt::format("one of the {} of its palette", palette.size())));
    const std::vector<std::uint8_t>& alphas = colours_.alphas;
    const std::uint16_t alpha = entry < alphas.size() ? alphas[entry] : 0xFF;
    return {.grey = 0, .colour = palette[entry], .alpha = alpha};
  }

  PngHeader header_;
  PngColours colours_;
};

}  // namespace

PictureKind kind_of(const PngHeader& header) {
  if (!header.colour) return header.bit_depth == 16 ? PictureKind::grey16 : PictureKind::grey8;
  if (header.bit_depth <= 8) return PictureKind::colour;
  throw DataError(
      fault("bits per channel", fmt::format("{}", header.bit_depth), "", "8 in a picture of colours"));
}

void read_rows(PngFile& file, const TakeRow& take) {
  const Pixels pixels(file);
  std::vector<PicturePixel> row(file.header().width_px);
  file.read([&](int y, std::span<const std::uint8_t> stored) {
    for (std::size_t x = 0; x < row.size(); ++x) row[x] = pixels.at(stored, x);
    take(y, row);
  });
}

namespace {

std::uint32_t number_of(const Colour& colour) noexcept {
  return static_cast<std::uint32_t>(colour[0]) << 16 | static_cast<std::uint32_t>(colour[1]) << 8 | colour[2];
}

Colour colour_of(std::uint32_t number) noexcept {
  return {static_cast<std::uint8_t>(number >> 16), static_cast<std::uint8_t>(number >> 8),
          static_cast<std::uint8_t>(number)};
}

std::string in_words(const Colour& colour) {
  return fmt::format("#{:06x} ({}, {}, {})", number_of(colour), colour[0], colour[1], colour[2]);
}

void check_needs(const PassNeeds& needs) {
  if (!needs.depth && !needs.normals) return;
  throw DataError(fmt::format(
      "no {} channel, which the chosen terms need; a picture of indices or colours has no other plane",
      needs.depth ? "depth" : "normal"));
}

std::uint16_t most_alpha(PictureKind kind) noexcept {
  return kind == PictureKind::grey16 ? std::numeric_limits<std::uint16_t>::max()
                                     : std::numeric_limits<std::uint8_t>::max();
}

/// The key of a survey: a number or a colour.
std::uint32_t value_of(const PicturePixel& pixel, PictureKind kind) noexcept {
  return kind == PictureKind::colour ? number_of(pixel.colour) : pixel.grey;
}

/// Converts rows of pixels to rows of indices.
class IndexRows {
 public:
  using IndexOf = std::unordered_map<std::uint32_t, std::uint16_t>;

  /// `index_of` null: numbers are indices.
  IndexRows(PictureKind kind, const IndexOf* index_of, Plane<std::uint16_t>& out)
      : kind_(kind), index_of_(index_of), opaque_(most_alpha(kind)), out_(out) {}

  void take(int y, std::span<const PicturePixel> row) {
    const auto out = out_.row(y);
    for (std::size_t x = 0; x < row.size(); ++x) out[x] = index_of(row[x], static_cast<int>(x), y);
  }

  /// Reports colours that match no object, counted to the end of the picture.
  void finish() const {
    if (unknown_pixels_ == 0) return;
    throw DataError(
        fmt::format("colour at pixel ({}, {}) = {} ({} pixels); expected an object's or the sky's{}",
                    unknown_x_px_, unknown_y_px_, in_words(colour_of(unknown_)), unknown_pixels_, nearest()));
  }

 private:
  std::uint16_t index_of(const PicturePixel& pixel, int x, int y) {
    if (pixel.alpha == 0) return kSkyIndex;
    if (pixel.alpha != opaque_) {
      throw DataError(fault(fmt::format("alpha at pixel ({}, {})", x, y), fmt::format("{}", pixel.alpha), "",
                            fmt::format("0 (sky) or {}, because a pixel belongs to one object", opaque_)));
    }
    if (index_of_ != nullptr)
      return index_of_colour(kind_ == PictureKind::colour ? number_of(pixel.colour) : pixel.grey * 0x010101U,
                             x, y);
    if (pixel.grey <= kLargestIndex) return pixel.grey;
    throw DataError(fault(fmt::format("index at pixel ({}, {})", x, y), fmt::format("{}", pixel.grey), "",
                          fmt::format("a whole number from 0 to {}", kLargestIndex)));
  }

  std::uint16_t index_of_colour(std::uint32_t colour, int x, int y) {
    if (colour == last_colour_) return last_index_;
    const auto found = index_of_->find(colour);
    if (found != index_of_->end()) {
      last_colour_ = colour;
      return last_index_ = found->second;
    }
    if (unknown_pixels_ == 0) {
      unknown_ = colour;
      unknown_x_px_ = x;
      unknown_y_px_ = y;
    }
    if (colour == unknown_) ++unknown_pixels_;
    return kSkyIndex;
  }

  /// The colour with the least sum of squared differences; the lower of two equal ones.
  [[nodiscard]] std::string nearest() const {
    std::pair<int, std::uint32_t> best = {std::numeric_limits<int>::max(), 0};
    for (const auto& [colour, index] : *index_of_) {
      int distance = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const int difference = colour_of(colour)[c] - colour_of(unknown_)[c];
        distance += difference * difference;
      }
      best = std::min(best, {distance, colour});
    }
    return fmt::format("; did you mean {}?", in_words(colour_of(best.second)));
  }

  static constexpr std::uint32_t kNoColour = 0xFF000000;

  PictureKind kind_;
  const IndexOf* index_of_;
  std::uint16_t opaque_;
  Plane<std::uint16_t>& out_;
  std::uint32_t last_colour_ = kNoColour;
  std::uint16_t last_index_ = 0;
  std::uint32_t unknown_ = kNoColour;
  int unknown_x_px_ = 0;
  int unknown_y_px_ = 0;
  std::int64_t unknown_pixels_ = 0;
};

std::vector<PictureUse> sorted_uses(const std::unordered_map<std::uint32_t, std::int64_t>& pixels,
                                    PictureKind kind) {
  const bool coloured = kind == PictureKind::colour;
  std::vector<PictureUse> uses;
  for (const auto& [value, count] : pixels) {
    uses.push_back({.value = coloured ? 0 : static_cast<int>(value),
                    .colour = coloured ? colour_of(value) : Colour{},
                    .pixels = count});
  }
  std::sort(uses.begin(), uses.end(), [](const PictureUse& a, const PictureUse& b) {
    return std::tuple(-a.pixels, a.value, a.colour) < std::tuple(-b.pixels, b.value, b.colour);
  });
  return uses;
}

}  // namespace

bool is_index_picture(const Path& file) { return lower_case(file.extension().string()) == ".png"; }

IndexPictures::IndexPictures(const Manifest& manifest, const ReadLimits& limits)
    : width_px_(passes_camera(manifest).width_px),
      height_px_(passes_camera(manifest).height_px),
      limits_(limits) {
  std::map<std::uint32_t, std::string> owners = {{number_of(manifest.sky_colour), "sky_colour"}};
  index_of_.emplace(number_of(manifest.sky_colour), kSkyIndex);
  for (std::size_t i = 0; i < manifest.objects.size(); ++i) {
    const ManifestObject& object = manifest.objects[i];
    if (!object.colour) continue;
    const std::string where = fmt::format("objects[{}].colour", i);
    const auto [owner, is_new] = owners.emplace(number_of(*object.colour), where);
    if (!is_new)
      throw DataError(fault(where, in_words(*object.colour), "", "a colour other than " + owner->second));
    index_of_.emplace(number_of(*object.colour), object.index);
    has_colours_ = true;
  }
}

Passes IndexPictures::read(const Path& file, const PassNeeds& needs) const {
  return naming(file, [&] {
    PngFile png(file);
    const PngHeader& header = png.header();
    check_size(header);
    check_plausible(header, limits_.pixels);
    check_needs(needs);
    const PictureKind kind = kind_of(header);
    if (kind == PictureKind::colour && !has_colours_)
      throw DataError(
          "a picture of colours; expected objects[].colour in the manifest, or a grey picture of indices");
    Passes passes;
    passes.object_index = Plane<std::uint16_t>(width_px_, height_px_);
    IndexRows rows(kind, has_colours_ && kind != PictureKind::grey16 ? &index_of_ : nullptr,
                   passes.object_index);
    read_rows(png, [&rows](int y, std::span<const PicturePixel> row) { rows.take(y, row); });
    rows.finish();
    return passes;
  });
}

void IndexPictures::check_size(const PngHeader& header) const {
  if (std::cmp_equal(header.width_px, width_px_) && std::cmp_equal(header.height_px, height_px_)) return;
  throw DataError(fault("size", fmt::format("{} x {}", header.width_px, header.height_px), "px",
                        fmt::format("the manifest's {} x {} px", width_px_, height_px_)));
}

PictureSurvey survey_picture(const Path& file, const ReadLimits& limits) {
  return naming(file, [&] {
    PngFile png(file);
    const PngHeader& header = png.header();
    check_plausible(header, limits.pixels);
    PictureSurvey survey = {.kind = kind_of(header),
                            .width_px = static_cast<int>(header.width_px),
                            .height_px = static_cast<int>(header.height_px),
                            .uses = {},
                            .transparent_pixels = 0,
                            .other_pixels = 0};
    std::unordered_map<std::uint32_t, std::int64_t> pixels;
    read_rows(png, [&](int, std::span<const PicturePixel> row) {
      for (const PicturePixel& pixel : row) {
        const std::uint32_t value = value_of(pixel, survey.kind);
        if (pixel.alpha != most_alpha(survey.kind)) {
          ++survey.transparent_pixels;
        } else if (pixels.size() < kMostPictureUses || pixels.contains(value)) {
          ++pixels[value];
        } else {
          ++survey.other_pixels;
        }
      }
    });
    survey.uses = sorted_uses(pixels, survey.kind);
    return survey;
  });
}

}  // namespace thermal
