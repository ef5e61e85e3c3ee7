#include <algorithm>
#include <bit>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/cryptomatte.h"
#include "io/exr_file.h"
#include "io/exr_indices.h"
#include "io/exr_planes.h"
#include "io/matte_ranks.h"

namespace thermal {
namespace {

/// A file's headers, and the selected cryptomatte.
struct Chosen {
  Chosen(const ExrFile& opened, const std::string& wanted, const ExrLayout& layout)
      : header(opened.header()) {
    check_size(header, layout);
    header.texts = opened.texts();
    all = cryptomattes_in(header);
    cryptomatte = &choose_cryptomatte(all, wanted, layout.layer);
  }

  /// Location of the other planes: relative to the first channel of the cryptomatte, as for an index plane.
  [[nodiscard]] ExrLayout layout_about(const ExrLayout& layout) const {
    ExrLayout about = layout;
    about.channels.object_index = cryptomatte->channels.front()->full_name();
    return about;
  }

  ExrHeader header;
  std::vector<Cryptomatte> all;
  const Cryptomatte* cryptomatte = nullptr;
};

MatteChannels channels_of(const Cryptomatte& cryptomatte) {
  MatteChannels mattes;
  for (const ExrChannel* channel : cryptomatte.channels) mattes.names.push_back(channel->full_name());
  mattes.planes.resize(cryptomatte.channels.size());
  return mattes;
}

/// Reads everything but the object index and the ranks, and the cryptomatte's own planes.
Passes decode(ExrFile& opened, const Chosen& chosen, const ExrLayout& layout, const PassNeeds& needs,
              MatteChannels& mattes) {
  const ExrLayout about = chosen.layout_about(layout);
  const ExrPlanes planes(chosen.header, about);
  Passes passes;
  std::vector<ExrTarget> targets;
  for (std::size_t k = 0; k < mattes.planes.size(); ++k)
    targets.push_back({.channel = chosen.cryptomatte->channels[k], .plane = &mattes.planes[k], .outside = 0});
  IndexPixels material_pixels;
  std::optional<ExrIndexPlane> materials;
  if (const ExrChannel* channel = planes.materials())
    targets.push_back(materials.emplace(*channel, material_pixels).target());
  for (const ExrTarget& target : shape_targets(planes, needs, passes)) targets.push_back(target);
  opened.decode(targets);
  if (materials) materials->indices(passes.material_index);
  return passes;
}

/// Maps the hashes of one file to the manifest's objects.
class HashIndices {
 public:
  HashIndices(const MatteNames& names, const Cryptomatte& cryptomatte, const MatteChannels& mattes)
      : names_(names), cryptomatte_(cryptomatte), mattes_(mattes) {}

  std::uint16_t of(std::uint32_t hash) const {
    const auto entry = cryptomatte_.names.find(hash);
    if (entry == cryptomatte_.names.end()) {
      if (const MatteNames::Matte* matte = names_.find_hash(hash)) return matte->index;
      const std::string& why = cryptomatte_.names_fault;
      throw unknown(hash, fmt::format("{:08x}", hash), "the hash of a name",
                    why.empty() ? "" : "; the file's names cannot be read: " + why);
    }
    try {
      if (const MatteNames::Matte* matte = names_.find(entry->second)) return matte->index;
    } catch (const DataError& error) {
      throw DataError(fmt::format("{}; {}", where(hash, entry->second), error.what()));
    }
    throw unknown(hash, entry->second, "a name", did_you_mean(entry->second, names_.texts()));
  }

 private:
  [[nodiscard]] std::string where(std::uint32_t hash, const std::string& value) const {
    const MatteSpot spot = spot_matte(mattes_, hash);
    return fmt::format("{} at pixel ({}, {}) = \"{}\" ({} pixels)", spot.channel, spot.x_px, spot.y_px, value,
                       spot.pixels);
  }

  [[nodiscard]] DataError unknown(std::uint32_t hash, const std::string& value, std::string_view what,
                                  const std::string& hint) const {
    return DataError(fmt::format("{}; expected {} among the manifest's objects: {}{}", where(hash, value),
                                 what, list_names(names_.texts()), hint));
  }

  const MatteNames& names_;
  const Cryptomatte& cryptomatte_;
  const MatteChannels& mattes_;
};

}  // namespace

std::vector<MatteUse> survey_mattes(const Path& file, const ExrHeader& header, const Cryptomatte& cryptomatte,
                                    const ExrLimits& limits) {
  if (!cryptomatte.fault.empty()) throw DataError(fmt::format("{}: {}", file.string(), cryptomatte.fault));
  const auto planes =
      read_exr_channels(file, header, {cryptomatte.channels[0], cryptomatte.channels[1]}, 0, limits);
  std::unordered_map<std::uint32_t, std::int64_t> pixels;
  for (std::size_t i = 0; i < planes[0].size(); ++i) {
    const bool covers = planes[1].pixels()[i] > 0;
    const std::uint32_t hash = covers ? std::bit_cast<std::uint32_t>(planes[0].pixels()[i]) : 0;
    if (pixels.size() < kMostMattes || pixels.contains(hash)) ++pixels[hash];
  }
  std::vector<MatteUse> uses;
  for (const auto& [hash, count] : pixels) {
    const auto entry = cryptomatte.names.find(hash);
    uses.push_back(
        {.hash = hash, .name = entry != cryptomatte.names.end() ? entry->second : "", .pixels = count});
  }
  std::sort(uses.begin(), uses.end(), [](const MatteUse& a, const MatteUse& b) {
    return std::pair(-a.pixels, a.hash) < std::pair(-b.pixels, b.hash);
  });
  return uses;
}

MatteTable::MatteTable(const Manifest& manifest)
    : cryptomatte_(manifest.cryptomatte), names_(manifest.objects) {}

Passes MatteTable::read(const Path& file, const ExrLayout& layout, const PassNeeds& needs) const {
  return with_exr_file(file, layout.limits, [&](ExrFile& opened) {
    const Chosen chosen(opened, cryptomatte_, layout);
    MatteChannels mattes = channels_of(*chosen.cryptomatte);
    Passes passes = decode(opened, chosen, layout, needs, mattes);
    const HashIndices indices(names_, *chosen.cryptomatte, mattes);
    rank_mattes(
        mattes, [&](std::uint32_t hash) { return indices.of(hash); }, passes);
    return passes;
  });
}

PassNeeds MatteTable::planes_in(const Path& file, const ExrLayout& layout) const {
  return with_exr_file(file, layout.limits, [&](const ExrFile& opened) {
    const Chosen chosen(opened, cryptomatte_, layout);
    const ExrLayout about = chosen.layout_about(layout);
    return planes_beside(ExrPlanes(chosen.header, about));
  });
}

}  // namespace thermal
