#include "io/bake/ground_maps_file.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>

#include <fmt/format.h>

#include "io/bake/array_file.h"
#include "io/json/schema.h"

namespace thermal {
namespace {

constexpr std::uint32_t kAllHours = (1U << 24U) - 1;

Path header_in(const Path& folder) { return folder / "ground.json"; }

std::vector<SunPath> sun_paths_in(const Json& header) {
  std::vector<SunPath> paths;
  for (const Json& path : header.at("sun_paths"))
    paths.push_back({.latitude_deg = path.at("latitude_deg"), .day_of_year = path.at("day_of_year")});
  return paths;
}

class MapsReader {
 public:
  MapsReader(const Path& folder, const Assets& assets)
      : file_(header_in(folder), assets.schema("ground_maps")), cells_(file_.header().at("cells")) {}

  /// `size_m` of the scene, if known.
  [[nodiscard]] GroundMaps read(std::optional<double> size_m) const {
    GroundMaps maps;
    maps.size_m = file_.header().at("size_m");
    maps.cells = cells_;
    if (size_m && maps.size_m != *size_m)
      throw file_.fault_at("size_m", fmt::format("{}", maps.size_m),
                           fmt::format("{}, as in scene.json", *size_m));
    maps.sky_view = map<std::uint8_t>("sky_view", "|u1");
    maps.height_m = heights("height_m");
    maps.crown_top_m = heights("crown_top_m");
    maps.moisture = map<std::uint8_t>("moisture", "|u1");
    if (has("water_m")) maps.water_m = heights("water_m");
    maps.covers = covers();
    check_not_below_0("crown_top_m", maps.crown_top_m);
    check_not_below_0("water_m", maps.water_m);
    maps.sunlit = sunlit();
    return maps;
  }

 private:
  [[nodiscard]] bool has(const char* name) const { return file_.header().at("arrays").contains(name); }

  void check_not_below_0(const char* name, const std::vector<float>& values) const {
    const auto below = std::ranges::find_if(values, [](float one) { return one < 0; });
    if (below != values.end())
      throw file_.fault_at(fmt::format("{}[{}]", name, below - values.begin()), fmt::format("{}", *below),
                           "0 or more");
  }

  template <typename Value>
  [[nodiscard]] std::vector<Value> map(const char* name, const char* type) const {
    return square<Value>(name, type, cells_);
  }

  template <typename Value>
  [[nodiscard]] std::vector<Value> square(const char* name, const char* type, std::size_t cells) const {
    const std::span<const Value> values = file_.array<Value>(name, type, {cells, cells});
    return {values.begin(), values.end()};
  }

  [[nodiscard]] GroundCovers covers() const {
    GroundCovers covers;
    covers.cells = file_.header().at("fine_cells");
    covers.kinds = file_.header().at("kinds").get<std::vector<std::string>>();
    const auto share = [&](const char* name) { return square<std::uint8_t>(name, "|u1", covers.cells); };
    covers.kind = share("kind");
    covers.grass = share("grass");
    covers.trodden = share("trodden");
    covers.ash = share("ash");
    covers.border = share("border");
    file_.check_below("kind", covers.kind, covers.kinds.size());
    return covers;
  }

  [[nodiscard]] std::vector<float> heights(const char* name) const {
    std::vector<float> values = map<float>(name, "<f4");
    file_.check_finite(name, std::span<const float>(values));
    return values;
  }

  [[nodiscard]] std::vector<SunlitHours> sunlit() const {
    const std::vector<SunPath> paths = sun_paths_in(file_.header());
    const auto hours = file_.array<std::uint32_t>("sunlit", "<u4", {paths.size(), cells_, cells_});
    const auto wrong = std::ranges::find_if(hours, [](std::uint32_t one) { return one > kAllHours; });
    if (wrong != hours.end())
      throw file_.fault_at(fmt::format("sunlit[{}]", wrong - hours.begin()), fmt::format("{}", *wrong),
                           "bits of 24 hours");
    std::vector<SunlitHours> sunlit;
    for (std::size_t k = 0; k < paths.size(); ++k) {
      const auto of_day = hours.subspan(k * cells_ * cells_, cells_ * cells_);
      sunlit.push_back({.path = paths[k], .hours = {of_day.begin(), of_day.end()}});
    }
    return sunlit;
  }

  ArrayFile file_;
  std::size_t cells_;
};

Json header_of(const GroundMaps& maps) {
  Json paths = Json::array();
  for (const SunlitHours& sunlit : maps.sunlit)
    paths.push_back({{"latitude_deg", sunlit.path.latitude_deg}, {"day_of_year", sunlit.path.day_of_year}});
  return {{"format", "veldt-ground-maps"},   {"version", 2},
          {"size_m", maps.size_m},           {"cells", maps.cells},
          {"fine_cells", maps.covers.cells}, {"kinds", maps.covers.kinds},
          {"sun_paths", std::move(paths)}};
}

}  // namespace

std::vector<SunPath> sun_paths_of_maps(const Path& folder, const Assets& assets) {
  const Path file = header_in(folder);
  Json header = read_json(file);
  const std::vector<std::string> faults = check_and_fill(header, assets.schema("ground_maps"));
  if (!faults.empty()) throw DataError(fmt::format("{}: {}", file.string(), faults.front()));
  return sun_paths_in(header);
}

GroundMaps read_ground_maps(const Path& folder, const BakedGround& ground, const Assets& assets) {
  return MapsReader(folder, assets).read(ground.size_m);
}

GroundMaps read_ground_maps(const Path& folder, const Assets& assets) {
  return MapsReader(folder, assets).read(std::nullopt);
}

void write_ground_maps(const GroundMaps& maps, const Path& folder, const Path& scratch) {
  ArrayWriter file(header_in(folder), scratch);
  const std::vector<std::size_t> shape = {maps.cells, maps.cells};
  file.add<std::uint8_t>("sky_view", "|u1", shape, maps.sky_view);
  file.add<float>("height_m", "<f4", shape, maps.height_m);
  file.add<float>("crown_top_m", "<f4", shape, maps.crown_top_m);
  file.add<std::uint8_t>("moisture", "|u1", shape, maps.moisture);
  if (!maps.water_m.empty()) file.add<float>("water_m", "<f4", shape, maps.water_m);
  const std::vector<std::size_t> fine = {maps.covers.cells, maps.covers.cells};
  file.add<std::uint8_t>("kind", "|u1", fine, maps.covers.kind);
  file.add<std::uint8_t>("grass", "|u1", fine, maps.covers.grass);
  file.add<std::uint8_t>("trodden", "|u1", fine, maps.covers.trodden);
  file.add<std::uint8_t>("ash", "|u1", fine, maps.covers.ash);
  file.add<std::uint8_t>("border", "|u1", fine, maps.covers.border);
  std::vector<std::uint32_t> hours;
  for (const SunlitHours& sunlit : maps.sunlit)
    hours.insert(hours.end(), sunlit.hours.begin(), sunlit.hours.end());
  file.add<std::uint32_t>("sunlit", "<u4", {maps.sunlit.size(), maps.cells, maps.cells}, hours);
  file.close(header_of(maps));
}

}  // namespace thermal
