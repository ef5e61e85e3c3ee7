#include "cli/read_limits.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"

namespace veldt {
namespace {

constexpr double kPixels = 1e6;
constexpr double kMostMegapixels = 1e6;

}  // namespace

void add_max_megapixels(CLI::App* command, double& max_megapixels) {
  command
      ->add_option("--max-megapixels", max_megapixels,
                   "Refuse files that claim more pixels, before memory is allocated for them")
      ->type_name("N")
      ->capture_default_str();
}

thermal::ReadLimits read_limits(double max_megapixels) {
  const double pixels = max_megapixels * kPixels;
  if (!(pixels >= 1 && max_megapixels <= kMostMegapixels)) {  // this form rejects NaN
    throw thermal::ConfigError(thermal::fault("--max-megapixels", fmt::format("{}", max_megapixels), "",
                                              "at least 0.000001 (a pixel) and at most 1000000"));
  }
  return {.pixels = std::llround(pixels)};
}

}  // namespace veldt
