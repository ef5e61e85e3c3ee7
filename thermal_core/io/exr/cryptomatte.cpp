#include "io/exr/cryptomatte.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/relative_name.h"
#include "base/text.h"
#include "io/exr/file.h"
#include "io/exr/mattes.h"
#include "io/exr/pixels.h"
#include "io/exr/planes.h"
#include "io/system/text_file.h"

namespace thermal {
namespace {

constexpr std::string_view kHash = "MurmurHash3_32";
constexpr std::string_view kConversion = "uint32_to_float32";

/// Twice as many as Blender can write; each takes memory for two planes.
constexpr std::size_t kMostRanks = 32;

/// Metadata of one cryptomatte, by field: name, hash, conversion, manifest, manif_file.
using Fields = std::map<std::string, std::string>;

/// By the key that groups them, usually seven hexadecimal digits of the name's hash.
std::map<std::string, Fields> fields_in(const ExrHeader& header) {
  std::map<std::string, Fields> by_key;
  for (const auto& [attribute, text] : header.texts) {
    std::vector<std::string_view> words = split(attribute, '/');
    if (words.front() == "exr") words.erase(words.begin());  // the other prefix that readers accept
    if (words.size() != 3 || words[0] != "cryptomatte") continue;
    by_key[std::string(words[1])].emplace(words[2], text);
  }
  return by_key;
}

std::string field(const Fields& fields, const std::string& name) {
  const auto found = fields.find(name);
  return found != fields.end() ? found->second : "";
}

void require(const Fields& fields, const std::string& name, std::string_view expected) {
  const std::string value = field(fields, name);
  if (value != expected)
    throw DataError(fault(name, fmt::format("\"{}\"", value), "", fmt::format("\"{}\"", expected)));
}

std::uint32_t hash_in(const std::string& name, const nlohmann::json& value) {
  const std::string digits = value.is_string() ? value.get<std::string>() : value.dump();
  std::uint32_t hash = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, hash, 16);
  if (digits.size() == 8 && error == std::errc() && stop == end) return hash_in_float(hash);
  throw DataError(fault(fmt::format("manifest[\"{}\"]", name), fmt::format("\"{}\"", digits), "",
                        "a hash of eight hexadecimal digits"));
}

/// Not parsed as Json, which keeps the order of keys and takes quadratic time in their number.
std::map<std::uint32_t, std::string> names_in(const std::string& manifest) {
  std::map<std::uint32_t, std::string> names;
  if (manifest.empty()) return names;
  const auto json = nlohmann::json::parse(manifest, nullptr, false);
  if (!json.is_object()) {
    throw DataError(fault("manifest", fmt::format("{} characters", manifest.size()), "",
                          "a JSON object of names and their hashes"));
  }
  for (const auto& [name, value] : json.items()) names.emplace(hash_in(name, value), name);
  return names;
}

/// 0 to 3 for a component of a channel's name, in any known spelling.
std::optional<std::size_t> component_of(std::string_view word) {
  static constexpr std::array<std::array<std::string_view, 4>, 4> kSpellings = {
      {{"r", "R", "red", "RED"},
       {"g", "G", "green", "GREEN"},
       {"b", "B", "blue", "BLUE"},
       {"a", "A", "alpha", "ALPHA"}}};
  for (std::size_t i = 0; i < kSpellings.size(); ++i) {
    if (std::find(kSpellings[i].begin(), kSpellings[i].end(), word) != kSpellings[i].end()) return i;
  }
  return std::nullopt;
}

/// Position of "<name>NN.<component>" among a cryptomatte's channels.
std::optional<std::size_t> place_of(std::string_view channel, std::string_view name) {
  if (!channel.starts_with(name) || channel.size() < name.size() + 4) return std::nullopt;
  channel.remove_prefix(name.size());
  const auto layer = number_in<std::size_t>(channel.substr(0, 2));
  const auto component = component_of(channel.substr(3));
  if (!layer || channel[2] != '.' || !component) return std::nullopt;
  return 4 * *layer + *component;
}

/// All ranks without a gap; the last layer may have a single rank.
std::vector<const ExrChannel*> channels_of(const ExrHeader& header, const std::string& name) {
  std::map<std::size_t, const ExrChannel*> by_place;
  for (const ExrChannel& channel : header.channels) {
    if (const auto place = place_of(channel.full_name(), name)) by_place.emplace(*place, &channel);
  }
  if (by_place.empty())
    throw DataError(fmt::format("no channels; expected {0}00.r, {0}00.g and so on", name));
  const std::size_t ranks = by_place.rbegin()->first / 2 + 1;
  if (ranks > kMostRanks)
    throw DataError(fault("ranks", fmt::format("{}", ranks), "", fmt::format("at most {}", kMostRanks)));
  const std::size_t count = ranks * 2;
  std::vector<const ExrChannel*> channels;
  for (std::size_t place = 0; place < count; ++place) {
    const auto found = by_place.find(place);
    if (found == by_place.end()) {
      throw DataError(fmt::format("no channel {}{:02}.{}; expected hash and coverage of every rank up to {}",
                                  name, place / 4, "rgba"[place % 4],
                                  by_place.rbegin()->second->full_name()));
    }
    channels.push_back(found->second);
  }
  return channels;
}

/// A hash needs all bits of a float: half has too few, and PXR24 keeps 24 of 32.
void check_exact(const ExrChannel& hash) {
  static constexpr std::array<std::string_view, 5> kLossy = {"PXR24", "B44", "B44A", "DWAA", "DWAB"};
  if (hash.type != "float") {
    throw DataError(
        fault(hash.full_name() + ": type", hash.type, "", "float, whose bits are the hashes of names"));
  }
  if (std::find(kLossy.begin(), kLossy.end(), hash.compression) != kLossy.end()) {
    throw DataError(fault(hash.full_name() + ": compression", hash.compression, "",
                          "one that keeps the bits of hashes: none, RLE, ZIPS, ZIP or PIZ"));
  }
}

/// The file that a header's manif_file names.
Path sidecar_of(const Path& folder, const std::string& named) {
  const auto name = RelativeName::of(named);
  if (!name) throw DataError(fmt::format("expected {}", RelativeName::kRule));
  Path file = folder;
  for (const std::string_view part : split(name->text(), '/')) check_is_no_link(file /= part);
  return file;
}

std::map<std::uint32_t, std::string> names_beside(const Path& folder, const std::string& named) {
  try {
    return names_in(read_text_file(sidecar_of(folder, named), kMostSidecarBytes));
  } catch (const Error& error) {
    throw DataError(fmt::format("manif_file = \"{}\": {}", printable(named), error.what()));
  }
}

void fill_names(Cryptomatte& cryptomatte, const Fields& fields, const Path& folder) {
  const std::string manifest = field(fields, "manifest");
  const std::string sidecar = field(fields, "manif_file");
  try {
    cryptomatte.names =
        manifest.empty() && !sidecar.empty() ? names_beside(folder, sidecar) : names_in(manifest);
  } catch (const DataError& error) {
    cryptomatte.names_fault = error.what();
  }
}

void fill(Cryptomatte& cryptomatte, const Fields& fields, const ExrHeader& header) {
  require(fields, "hash", kHash);
  require(fields, "conversion", kConversion);
  cryptomatte.channels = channels_of(header, cryptomatte.name);
  for (std::size_t k = 0; k < cryptomatte.channels.size(); k += 2) check_exact(*cryptomatte.channels[k]);
}

Cryptomatte cryptomatte_of(const std::string& key, const Fields& fields, const ExrHeader& header) {
  Cryptomatte cryptomatte = {
      .name = field(fields, "name"), .names = {}, .channels = {}, .names_fault = "", .fault = ""};
  if (cryptomatte.name.empty()) {
    cryptomatte.name = key;
    cryptomatte.fault =
        fmt::format("cryptomatte with the key {}: no name; expected that of its channels", key);
    return cryptomatte;
  }
  try {
    fill_names(cryptomatte, fields, header.folder);
    fill(cryptomatte, fields, header);
  } catch (const DataError& error) {
    cryptomatte.fault = fmt::format("cryptomatte {}: {}", cryptomatte.name, error.what());
  }
  return cryptomatte;
}

/// What follows the last dot.
std::string short_name(const std::string& name) { return name.substr(name.rfind('.') + 1); }

DataError no_such(std::span<const Cryptomatte> cryptomattes, const std::string& wanted) {
  std::vector<std::string> names;
  for (const Cryptomatte& each : cryptomattes) names.push_back(each.name);
  const std::string rule = names.empty() ? "a file with cryptomattes; this one has none"
                                         : "one that the file has: " + list_names(names);
  for (const Cryptomatte& each : cryptomattes) names.push_back(short_name(each.name));
  return DataError(fault("cryptomatte", fmt::format("\"{}\"", wanted), "", rule) +
                   did_you_mean(wanted, names));
}

DataError several(std::span<const Cryptomatte* const> alike, const std::string& wanted) {
  std::vector<std::string> names;
  for (const Cryptomatte* each : alike) names.push_back(each->name);
  return DataError(
      fault("cryptomatte", fmt::format("\"{}\"", wanted), "", "the whole name of one: " + list_names(names)));
}

}  // namespace

std::vector<Cryptomatte> cryptomattes_in(const ExrHeader& header) {
  std::map<std::string, Cryptomatte> by_name;
  for (const auto& [key, fields] : fields_in(header)) {
    Cryptomatte cryptomatte = cryptomatte_of(key, fields, header);
    std::string name = cryptomatte.name;
    by_name.emplace(std::move(name), std::move(cryptomatte));
  }
  std::vector<Cryptomatte> cryptomattes;
  for (auto& [name, cryptomatte] : by_name) cryptomattes.push_back(std::move(cryptomatte));
  return cryptomattes;
}

std::vector<Path> sidecars_of(const ExrHeader& header) {
  std::vector<Path> files;
  for (const auto& [key, fields] : fields_in(header)) {
    const std::string name = field(fields, "manif_file");
    try {
      if (!name.empty()) files.push_back(sidecar_of(header.folder, name));
    } catch (const Error&) {
      continue;  // never read, and refused by cryptomattes_in()
    }
  }
  return files;
}

const Cryptomatte& choose_cryptomatte(std::span<const Cryptomatte> cryptomattes, const std::string& wanted,
                                      const std::string& layer) {
  std::vector<const Cryptomatte*> alike;
  const Cryptomatte* found = nullptr;
  for (const Cryptomatte& each : cryptomattes) {
    const bool in_layer = !layer.empty() && each.name == fmt::format("{}.{}", layer, wanted);
    if (each.name == wanted || (in_layer && found == nullptr)) found = &each;
    if (short_name(each.name) == wanted) alike.push_back(&each);
  }
  if (found == nullptr && alike.empty()) throw no_such(cryptomattes, wanted);
  if (found == nullptr && alike.size() > 1) throw several(alike, wanted);
  if (found == nullptr) found = alike.front();
  if (!found->fault.empty()) throw DataError(found->fault);
  return *found;
}

namespace {

/// A file's headers, and the selected cryptomatte.
struct Chosen {
  Chosen(const ExrFile& opened, const std::string& wanted, const ExrLayout& layout)
      : header(opened.header()) {
    check_size(header, layout);
    check_projection(header, layout);
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
  for (const ExrTarget& target : shape_targets(planes, needs, passes.depth_m, passes.normal))
    targets.push_back(target);
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
