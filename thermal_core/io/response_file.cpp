#include "io/response_file.h"

#include <charconv>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {
namespace {

constexpr std::string_view kHeader = "wavelength_um,response";

SpectralResponse::Sample parse_sample(const std::string& line, const std::string& where) {
  SpectralResponse::Sample sample{};
  const char* const end = line.data() + line.size();
  const auto first = std::from_chars(line.data(), end, sample.wavelength_um);
  const bool comma = first.ec == std::errc() && first.ptr != end && *first.ptr == ',';
  const auto second = comma ? std::from_chars(first.ptr + 1, end, sample.response) : first;
  if (comma && second.ec == std::errc() && second.ptr == end) return sample;
  throw ConfigError(fault(where, fmt::format("\"{}\"", line), "", "two numbers: wavelength_um,response"));
}

}  // namespace

SpectralResponse read_response(const Path& file) {
  std::istringstream lines(read_file(file));
  std::vector<SpectralResponse::Sample> samples;
  bool header = false;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty() || line.starts_with('#')) continue;
    const std::string where = fmt::format("{}:{}", file.string(), number);
    if (header) {
      samples.push_back(parse_sample(line, where));
    } else if (line != kHeader) {
      throw ConfigError(fault(where, fmt::format("\"{}\"", line), "", fmt::format("the header {}", kHeader)));
    }
    header = true;
  }
  try {
    return SpectralResponse(std::move(samples));
  } catch (const ConfigError& error) {
    throw ConfigError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace thermal
