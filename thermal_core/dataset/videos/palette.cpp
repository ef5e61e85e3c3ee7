#include "dataset/videos/palette.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

PaletteTable grey(bool white_hot) {
  PaletteTable table{};
  for (std::size_t k = 0; k < table.size(); ++k) {
    const auto level = static_cast<std::uint8_t>(white_hot ? k : 255 - k);
    table[k] = {level, level, level};
  }
  return table;
}

/// A colour at a position from cold (0) to hot (1).
struct ColourStop {
  double share;
  std::array<double, 3> colour;
};

/// Thermal cameras' usual "iron": estimated from vendors' pictures, with steadily rising lightness.
constexpr std::array<ColourStop, 8> kIronbow = {{{0.00, {0, 0, 12}},
                                                 {0.12, {34, 4, 104}},
                                                 {0.28, {112, 8, 150}},
                                                 {0.44, {186, 26, 126}},
                                                 {0.58, {228, 76, 44}},
                                                 {0.72, {248, 142, 8}},
                                                 {0.87, {254, 208, 60}},
                                                 {1.00, {255, 254, 244}}}};

PaletteColour mixed(const ColourStop& from, const ColourStop& to, double share) {
  PaletteColour colour{};
  const double t = (share - from.share) / (to.share - from.share);
  for (std::size_t c = 0; c < colour.size(); ++c)
    colour[c] = static_cast<std::uint8_t>(std::lround(from.colour[c] + t * (to.colour[c] - from.colour[c])));
  return colour;
}

PaletteTable ironbow() {
  PaletteTable table{};
  std::size_t stop = 0;
  for (std::size_t k = 0; k < table.size(); ++k) {
    const double share = static_cast<double>(k) / 255;
    while (stop + 2 < kIronbow.size() && share > kIronbow[stop + 1].share) ++stop;
    table[k] = mixed(kIronbow[stop], kIronbow[stop + 1], share);
  }
  return table;
}

PaletteTable of_opencv(cv::ColormapTypes map) {
  cv::Mat levels(1, 256, CV_8UC1);
  for (int k = 0; k < 256; ++k) levels.at<std::uint8_t>(0, k) = static_cast<std::uint8_t>(k);
  cv::Mat colours;  // blue, green, red
  cv::applyColorMap(levels, colours, map);
  PaletteTable table{};
  for (int k = 0; k < 256; ++k) {
    const auto& colour = colours.at<cv::Vec3b>(0, k);
    table[static_cast<std::size_t>(k)] = {colour[2], colour[1], colour[0]};
  }
  return table;
}

/// OpenCV's begins with red, which thermal cameras use for the hottest.
PaletteTable rainbow() {
  PaletteTable table = of_opencv(cv::COLORMAP_RAINBOW);
  std::ranges::reverse(table);
  return table;
}

/// Light, and as different as possible in hue from each other and from every palette; by category id, so that a species
/// has one colour in all videos.
constexpr std::array<PaletteColour, 18> kCategoryColours = {{{0, 229, 255},      // human
                                                             {124, 255, 107},    // elephant
                                                             {255, 214, 10},     // rhinoceros
                                                             {255, 110, 199},    // hippopotamus
                                                             {255, 255, 255},    // zebra
                                                             {255, 138, 76},     // lion
                                                             {90, 255, 190},     // crocodile
                                                             {173, 160, 255},    // giraffe
                                                             {214, 255, 61},     // impala
                                                             {255, 82, 82},      // vehicle
                                                             {133, 196, 255},    // cattle
                                                             {255, 183, 213},    // goat
                                                             {226, 122, 255},    // dog
                                                             {255, 190, 130},    // baboon
                                                             {170, 225, 130},    // warthog
                                                             {120, 160, 255},    // ostrich
                                                             {230, 220, 160},    // buffalo
                                                             {150, 235, 235}}};  // wildebeest

}  // namespace

const std::vector<std::string>& palette_names() {
  static const std::vector<std::string> kNames = {"white_hot", "black_hot", "ironbow", "rainbow",
                                                  "inferno",   "viridis",   "turbo"};
  return kNames;
}

PaletteTable palette_table(const std::string& name) {
  if (name == "white_hot") return grey(true);
  if (name == "black_hot") return grey(false);
  if (name == "ironbow") return ironbow();
  if (name == "rainbow") return rainbow();
  if (name == "inferno") return of_opencv(cv::COLORMAP_INFERNO);
  if (name == "viridis") return of_opencv(cv::COLORMAP_VIRIDIS);
  if (name == "turbo") return of_opencv(cv::COLORMAP_TURBO);
  throw ConfigError(
      fault("--palette", fmt::format("\"{}\"", name), "", "one of " + list_names(palette_names())) +
      did_you_mean(name, palette_names()));
}

PaletteColour category_colour(const LabelId& id) noexcept {
  const auto* const number = std::get_if<std::int64_t>(&id);
  const std::int64_t index = number == nullptr ? 0 : std::max<std::int64_t>(1, *number) - 1;
  return kCategoryColours[static_cast<std::size_t>(index) % kCategoryColours.size()];
}

}  // namespace thermal
