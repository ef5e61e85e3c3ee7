#include <algorithm>
#include <cmath>

#include "fuzz/targets.h"
#include "io/config/photo_view.h"
#include "io/image/kelvin_picture.h"
#include "io/image/picture_module.h"
#include "io/image/pictures.h"

namespace {

/// The readers go by the extension: one that fits how the bytes begin.
std::string name_for(Bytes bytes) {
  const std::string_view text = text_of(bytes);
  if (text.starts_with("\x89PNG")) return "picture.png";
  return text.starts_with("II") || text.starts_with("MM") ? "picture.tif" : "picture.jpg";
}

void demand_grey(const thermal::GreyPicture& picture) {
  demand(!picture.levels.empty(), "a picture without pixels");
  demand(picture.bits == 8 || picture.bits == 16, "levels of 8 or 16 bits");
  if (picture.bits == 8)
    demand(std::ranges::all_of(picture.levels.pixels(), [](int level) { return level <= 255; }),
           "levels that fit their bits");
}

void demand_finite(const thermal::Plane<float>& kelvin) {
  demand(!kelvin.empty(), "a picture without pixels");
  demand(std::ranges::all_of(kelvin.pixels(), [](float value) { return std::isfinite(value); }),
         "finite temperatures");
}

void demand_view(const thermal::PhotoView& view) {
  demand(!view.altitude_m || (*view.altitude_m >= 1 && *view.altitude_m <= 5000), "a height of a flight");
  demand(!view.look_angle_deg || (*view.look_angle_deg >= 1 && *view.look_angle_deg <= 90),
         "a view of the ground");
  demand(!view.heading_deg || std::abs(*view.heading_deg) <= 180, "a heading");
}

}  // namespace

void fuzz::picture(Bytes bytes) {
  (void)thermal::picture_module();  // where it cannot be loaded, nothing would be tested
  const auto file = as_file(bytes, name_for(bytes));
  tolerate([&] { demand_grey(thermal::read_grey_picture(file)); });
  tolerate([&] { demand_finite(thermal::read_kelvin_picture(file)); });
  tolerate([&] {
    demand_finite(thermal::read_kelvin_picture(
        file, {.kelvin_per_count = 0.01, .unit = thermal::TemperatureUnit::celsius}));
  });
  tolerate([&] { demand(!thermal::as_jpeg(file, 16).empty(), "a JPEG of what was read"); });
  tolerate([&] { demand_view(thermal::read_photo_view(thermal::read_photo_tags(file), {})); });
}
