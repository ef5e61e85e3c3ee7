#include "io/image/kelvin_picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/image/picture_module.h"
#include "io/image/png.h"
#include "io/system/naming.h"

namespace thermal {
namespace {

StoredTemperatures stored_png(const Path& file) {
  const Plane<std::uint16_t> counts = read_png16(file);
  StoredTemperatures stored = {.values = Plane<float>(counts.width_px(), counts.height_px()), .counts = true};
  std::ranges::copy(counts.pixels(), stored.values.pixels().begin());
  return stored;
}

StoredTemperatures stored_tiff(const Path& file) {
  check_is_file(file);
  return naming(file, [&file] { return picture_module().read_temperatures(file); });
}

void check_kelvin(const Path& file, const Plane<float>& kelvin) {
  constexpr float kLeastK = 100;
  constexpr float kMostK = 3000;
  const std::string rule =
      fmt::format("kelvin: finite, and {} to {} for half of the pixels", kLeastK, kMostK);
  std::vector<float> values(kelvin.pixels().begin(), kelvin.pixels().end());
  if (!std::ranges::all_of(values, [](float value) { return std::isfinite(value); }))
    throw DataError(fault(file.string() + ": pixels", "not finite", "", rule));
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (!(*middle >= kLeastK && *middle <= kMostK))
    throw DataError(fault(file.string() + ": median of the pixels", fmt::format("{:g}", *middle), "", rule));
}

}  // namespace

Plane<float> read_kelvin_picture(const Path& file, std::optional<double> kelvin_per_count) {
  const bool png = lower_case(file.extension().string()) == ".png";
  StoredTemperatures stored = png ? stored_png(file) : stored_tiff(file);
  if (stored.counts && kelvin_per_count) {
    stored.scale = kelvin_per_count;
    stored.offset = 0;
  }
  if (stored.counts && !stored.scale)
    throw DataError(fault(file.string() + ": scale of its counts", "unknown", "",
                          "kelvin per count in its tags or as an option"));
  if (stored.scale)
    for (float& value : stored.values.pixels())
      value = static_cast<float>(static_cast<double>(value) * *stored.scale + stored.offset);
  check_kelvin(file, stored.values);
  return std::move(stored.values);
}

}  // namespace thermal
