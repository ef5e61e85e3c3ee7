#include "io/image/kelvin_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/plausible.h"
#include "base/text.h"
#include "io/image/picture_module.h"
#include "io/image/png.h"
#include "io/system/files.h"

namespace thermal {
namespace {

constexpr double kZeroCelsius = 273.15;  // [K]

StoredTemperatures stored_png(const Path& file) {
  const Plane<std::uint16_t> counts = read_png16(file);
  StoredTemperatures stored = {.values = Plane<float>(counts.width_px(), counts.height_px()), .counts = true};
  std::ranges::copy(counts.pixels(), stored.values.pixels().begin());
  return stored;
}

StoredTemperatures stored_in(const Path& file) {
  if (lower_case(file.extension().string()) == ".png") return stored_png(file);
  check_is_file(file);
  return naming(file, [&file] { return picture_module().read_temperatures(file); });
}

/// Ignores everything but letters: "deg C", "°C" and "Celsius" are alike. Empty for an unknown unit.
std::optional<TemperatureUnit> unit_named(const std::string& name) {
  std::string letters;
  for (const char c : lower_case(name))
    if (c >= 'a' && c <= 'z') letters += c;
  for (const char* kelvin : {"k", "kelvin", "degk"})
    if (letters == kelvin) return TemperatureUnit::kelvin;
  for (const char* celsius : {"c", "celsius", "degc", "degreescelsius"})
    if (letters == celsius) return TemperatureUnit::celsius;
  if (name.empty()) return std::nullopt;
  throw DataError(fault("UNITTYPE of its tags", fmt::format("\"{}\"", name), "", "K or C"));
}

/// Conversion of stored values to kelvin: value x scale + offset.
struct ToKelvin {
  double scale = 1;
  double offset = 0;
  bool celsius = false;

  [[nodiscard]] float of(float stored) const {
    return static_cast<float>(static_cast<double>(stored) * scale + offset);
  }
};

ToKelvin to_kelvin(const StoredTemperatures& stored, const StoredScale& said) {
  ToKelvin conversion = {.scale = stored.scale.value_or(1), .offset = stored.scale ? stored.offset : 0};
  if (stored.counts && said.kelvin_per_count) conversion = {.scale = *said.kelvin_per_count};
  if (stored.counts && !stored.scale && !said.kelvin_per_count)
    throw DataError(
        fault("scale of its counts", "unknown", "",
              fmt::format("kelvin per count in its tags or as an option: {0}kelvin-per-count 0.01, or 0.1 "
                          "with {0}unit celsius for tenths of a degree",
                          said.prefix)));
  conversion.celsius = (said.unit ? said.unit : unit_named(stored.unit)).value_or(TemperatureUnit::kelvin) ==
                       TemperatureUnit::celsius;
  if (conversion.celsius) conversion.offset += kZeroCelsius;
  return conversion;
}

/// Pixels that are not temperatures: their number, and the first.
struct Misfits {
  std::size_t count = 0;
  std::size_t first = 0;
};

template <typename IsMisfit>
Misfits misfits_in(const Plane<float>& values, const IsMisfit& is_misfit) {
  Misfits found;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (is_misfit(values.pixels()[k]) && found.count++ == 0) found.first = k;
  return found;
}

/// "3 of 64 pixels WHAT, the first at (5, 2)".
std::string in_words(const Misfits& misfits, const Plane<float>& values, const std::string& what) {
  const auto width = static_cast<std::size_t>(values.width_px());
  return fmt::format("{} of {} pixels {}, the first at ({}, {})", misfits.count, values.size(), what,
                     misfits.first % width, misfits.first / width);
}

void check_all_have_values(const StoredTemperatures& stored) {
  if (!stored.no_data) return;
  const auto no_data = static_cast<float>(*stored.no_data);
  const Misfits empty = misfits_in(stored.values, [no_data](float value) {
    return value == no_data || (std::isnan(value) && std::isnan(no_data));
  });
  if (empty.count == 0) return;
  throw DataError(fmt::format(
      "{}; expected a temperature in every pixel",
      in_words(empty, stored.values, fmt::format("have no value (GDAL_NODATA = {:g})", *stored.no_data))));
}

/// Median of the finite values; NaN if there are none.
double median_of_finite(const Plane<float>& plane) {
  std::vector<float> values;
  std::ranges::copy_if(plane.pixels(), std::back_inserter(values),
                       [](float value) { return std::isfinite(value); });
  if (values.empty()) return std::nan("");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

/// Checked before single pixels: with another unit or scale, all of them are wrong.
void check_median(const Plane<float>& kelvin, const ToKelvin& conversion, const StoredScale& said) {
  const double median_k = median_of_finite(kelvin);
  if (kSceneMedianK.holds(median_k)) return;
  const bool may_be_celsius = !conversion.celsius && kSceneMedianK.holds(median_k + kZeroCelsius);
  throw DataError(fault(
      "median of the pixels", fmt::format("{:.6g}", median_k),
      fmt::format("K ({:.6g} deg C)", median_k - kZeroCelsius),
      fmt::format("{} to {} K ({:.6g} to {:.6g} deg C); {}", kSceneMedianK.least, kSceneMedianK.most,
                  kSceneMedianK.least - kZeroCelsius, kSceneMedianK.most - kZeroCelsius,
                  may_be_celsius
                      ? fmt::format("if these are degrees Celsius, add {}unit celsius", said.prefix)
                      : fmt::format("check unit and scale ({0}unit, {0}kelvin-per-count)", said.prefix))));
}

void check_pixels(const Plane<float>& kelvin, const StoredTemperatures& stored) {
  const Misfits wrong =
      misfits_in(kelvin, [](float value) { return !kTemperatureK.holds(static_cast<double>(value)); });
  if (wrong.count == 0) return;
  const float stored_value = stored.values.pixels()[wrong.first];
  const float value_k = kelvin.pixels()[wrong.first];
  const std::string value = stored_value == value_k || std::isnan(value_k)
                                ? fmt::format("{:.6g} K", value_k)
                                : fmt::format("{:.6g} K ({:.6g} as stored)", value_k, stored_value);
  throw DataError(fmt::format("{} = {}; expected {} to {} K in every pixel",
                              in_words(wrong, kelvin, "are no temperatures"), value, kTemperatureK.least,
                              kTemperatureK.most));
}

}  // namespace

Plane<float> read_kelvin_picture(const Path& file, const StoredScale& scale) {
  const StoredTemperatures stored = stored_in(file);
  return naming(file, [&] {
    check_all_have_values(stored);
    const ToKelvin conversion = to_kelvin(stored, scale);
    Plane<float> kelvin(stored.values.width_px(), stored.values.height_px());
    std::ranges::transform(stored.values.pixels(), kelvin.pixels().begin(),
                           [&conversion](float value) { return conversion.of(value); });
    check_median(kelvin, conversion, scale);
    check_pixels(kelvin, stored);
    return kelvin;
  });
}

}  // namespace thermal
