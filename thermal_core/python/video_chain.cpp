#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "base/rng.h"
#include "io/assets.h"
#include "io/config/distribution.h"
#include "io/config/sensor.h"
#include "io/json/schema.h"
#include "python/arrays.h"
#include "python/parts.h"
#include "sensor/analogue_link.h"
#include "sensor/processing.h"
#include "sensor/streams.h"

namespace thermal::python {
namespace {

constexpr int kCountsPerLevel = 256;
constexpr std::size_t kNoisyPixelsPerChunk = 128 * kRandomBatch;
constexpr double kLeastCount = 1;  // 0 and 65535 are pixels without a measurement
constexpr double kMostCount = 65534;
constexpr const char* kFieldMotion = "field_motion_px";
constexpr const char* kNoise = "noise_levels";

/// The schema of a chain's settings, from that of configs.
Json rules_of_chain(const Json& schema) {
  return {{"type", "object"},
          {"additionalProperties", false},
          {"properties",
           {{kNoise, {{"type", "number"}, {"minimum", 0}, {"maximum", 100}, {"default", 0}}},
            {"processing", schema["properties"]["sensor"]["properties"]["processing"]},
            {"link", schema["properties"]["output"]["properties"]["link"]},
            {kFieldMotion, {{"type", "number"}, {"minimum", -100}, {"maximum", 100}, {"default", 0}}}}}};
}

Plane<std::uint16_t> counts_of(const Plane<std::uint8_t>& picture) {
  Plane<std::uint16_t> counts(picture.width_px(), picture.height_px());
  for (std::size_t i = 0; i < picture.size(); ++i)
    counts.pixels()[i] =
        static_cast<std::uint16_t>(kCountsPerLevel * picture.pixels()[i] + kCountsPerLevel / 2);
  return counts;
}

/// Adds the white noise of another detector.
void add_noise(double levels, const RandomField& field, Plane<std::uint16_t>& counts) {
  const auto pixels = counts.pixels();
  parallel_for(pixels.size(), kNoisyPixelsPerChunk, [&](std::size_t begin, std::size_t end) {
    std::vector<float> noise(end - begin);
    fill_normal(field, begin, noise);
    for (std::size_t i = begin; i < end; ++i) {
      const double noisy = pixels[i] + kCountsPerLevel * levels * static_cast<double>(noise[i - begin]);
      pixels[i] = static_cast<std::uint16_t>(std::clamp(std::round(noisy), kLeastCount, kMostCount));
    }
  });
}

void process(const ProcessingParameters& parameters, const Plane<std::uint16_t>& counts,
             Plane<std::uint8_t>& picture) {
  const auto levels = picture.pixels();
  Processing processing(parameters);
  const auto filtered = processing.filter(counts).pixels();
  for (std::size_t i = 0; i < levels.size(); ++i)
    levels[i] = static_cast<std::uint8_t>(filtered[i] / kCountsPerLevel);
}

/// Passes pictures through a chain drawn for each of them.
class VideoChain {
 public:
  VideoChain(const std::string& settings, const std::string& home, std::uint32_t seed)
      : settings_(parse_json(settings, "settings")),
        rules_(rules_of_chain(Assets(home).schema("config"))),
        seed_(seed) {
    (void)drawn(0);
  }

  [[nodiscard]] py::array_t<std::uint8_t> pass(const py::object& given, std::uint32_t number) const {
    Plane<std::uint8_t> picture = levels_of(given, "picture");
    {
      const py::gil_scoped_release others_run;
      const Json settings = drawn(number);
      Plane<std::uint16_t> counts = counts_of(picture);
      if (const double levels = settings[kNoise].get<double>(); levels > 0)
        add_noise(levels, {.seed = seed_, .stream = kChainNoiseStream, .frame = number}, counts);
      process(read_processing(settings["processing"]), counts, picture);
      if (settings.contains("link")) send(settings, number, picture);
    }
    return array_of(std::move(picture));
  }

 private:
  [[nodiscard]] Json drawn(std::uint32_t number) const {
    Json settings = settings_;
    std::vector<std::string> faults;
    (void)draw_within(settings, rules_, {.seed = seed_, .owner = std::to_string(number)}, "", faults);
    if (settings.is_object() && settings.contains("link") && settings["link"].is_null())
      settings.erase("link");
    if (faults.empty()) faults = check_and_fill(settings, rules_);
    throw_faults(faults, "settings");
    return settings;
  }

  void send(const Json& settings, std::uint32_t number, Plane<std::uint8_t>& picture) const {
    const AnalogueLinkParameters parameters = read_link(settings["link"]);
    AnalogueLink link(parameters, {.seed = seed_,
                                   .id = std::to_string(number),
                                   .width_px = picture.width_px(),
                                   .height_px = picture.height_px()});
    link.pass(settings[kFieldMotion].get<float>(), picture);
  }

  Json settings_;
  Json rules_;
  std::uint32_t seed_;
};

}  // namespace

void add_video_chain(py::module_& module) {
  py::class_<VideoChain>(module, "VideoChain")
      .def(py::init<const std::string&, const std::string&, std::uint32_t>(), py::arg("settings"),
           py::arg("home"), py::arg("seed"))
      .def("pass_through", &VideoChain::pass, py::arg("picture"), py::arg("number"));
}

}  // namespace thermal::python
