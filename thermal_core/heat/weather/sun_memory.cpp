#include "heat/weather/sun_memory.h"

#include <algorithm>
#include <cmath>

#include "heat/weather/forcing.h"

namespace thermal {

SunMemory sun_memory(const DayWeather& weather, double solar_h) noexcept {
  constexpr double kShortestH = 0.25;  // the hour that the moment is in
  std::array<double, 24> left{};
  double sum = 0;
  for (std::size_t hour = 0; hour < left.size(); ++hour) {
    const double middle_h = static_cast<double>(hour) + 0.5;
    const Forcing forcing = forcing_at(weather, middle_h);
    const double since_h = (solar_h - middle_h) - 24 * std::floor((solar_h - middle_h) / 24);
    left[hour] =
        std::max(0.0, forcing.global_w_m2 - forcing.diffuse_w_m2) / std::sqrt(std::max(since_h, kShortestH));
    sum += left[hour];
  }
  SunMemory memory{};
  for (std::size_t hour = 0; hour < left.size(); ++hour)
    memory[hour] = sum > 0 ? static_cast<float>(left[hour] / sum) : 0.0F;
  return memory;
}

float sunlit_share(const SunMemory& memory, std::uint32_t hours) noexcept {
  float share = 0;
  for (std::size_t hour = 0; hour < memory.size(); ++hour) {
    if ((hours >> hour & 1U) != 0) share += memory[hour];
  }
  return share;
}

}  // namespace thermal
