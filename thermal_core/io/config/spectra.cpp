#include "io/config/spectra.h"

#include <charconv>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "io/system/text_file.h"

namespace thermal {
namespace {

struct Pair {
  double wavelength_um;
  double value;
};

Pair parse_pair(const std::string& line, const std::string& where, std::string_view header) {
  Pair pair{};
  const char* const end = line.data() + line.size();
  const auto first = std::from_chars(line.data(), end, pair.wavelength_um);
  const bool comma = first.ec == std::errc() && first.ptr != end && *first.ptr == ',';
  const auto second = comma ? std::from_chars(first.ptr + 1, end, pair.value) : first;
  if (comma && second.ec == std::errc() && second.ptr == end) return pair;
  throw ConfigError(fault(where, fmt::format("\"{}\"", line), "", fmt::format("two numbers: {}", header)));
}

std::vector<Pair> read_pairs(const Path& file, std::string_view header) {
  std::vector<Pair> pairs;
  bool past_header = false;
  for_table_lines(file, [&](const std::string& line, const std::string& where) {
    if (past_header) {
      pairs.push_back(parse_pair(line, where, header));
    } else if (line != header) {
      throw ConfigError(fault(where, fmt::format("\"{}\"", line), "", fmt::format("the header {}", header)));
    }
    past_header = true;
  });
  return pairs;
}

/// Reads pairs and makes a curve of them; faults in the curve get the file's name.
template <typename Curve>
Curve read_curve(const Path& file, std::string_view header) {
  std::vector<typename Curve::Sample> samples;
  for (const auto& [wavelength_um, value] : read_pairs(file, header))
    samples.push_back({wavelength_um, value});
  try {
    return Curve(std::move(samples));
  } catch (const ConfigError& error) {
    throw ConfigError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace

SpectralResponse read_response(const Path& file) {
  return read_curve<SpectralResponse>(file, "wavelength_um,response");
}

EmissivitySpectrum read_emissivity(const Path& file) {
  return read_curve<EmissivitySpectrum>(file, "wavelength_um,emissivity");
}

}  // namespace thermal
