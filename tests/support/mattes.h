#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include "io/exr/mattes.h"
#include "scene/manifest.h"
#include "support/exr.h"

inline thermal::ManifestObject matte_object(std::uint16_t index, const std::string& name,
                                            const std::vector<std::string>& mattes = {}) {
  thermal::ManifestObject object;
  object.index = index;
  object.name = name;
  object.mattes = mattes;
  return object;
}

/// A rank of a synthetic cryptomatte: what covers each pixel most, or next, and its coverage; "" is nothing.
struct MatteRank {
  std::vector<std::string> names;
  std::vector<float> coverage;
};

/// Attributes of an EXR file by name.
using ExrTexts = std::map<std::string, std::string>;

/// A float with the bits of a name's hash.
inline float matte_float(const std::string& name) {
  return name.empty() ? 0.0F : std::bit_cast<float>(thermal::cryptomatte_hash(name));
}

/// Channels of a cryptomatte: two ranks per layer, the last layer always complete, as renderers write it.
inline ExrChannels matte_channels(const std::vector<MatteRank>& ranks,
                                  const std::string& name = "ViewLayer.CryptoObject",
                                  const std::string& components = "rgba") {
  ExrChannels channels;
  for (std::size_t k = 0; k < (ranks.size() + 1) / 2 * 2; ++k) {
    const std::size_t pixels = ranks.front().coverage.size();
    const MatteRank& rank =
        k < ranks.size() ? ranks[k] : MatteRank{std::vector<std::string>(pixels), std::vector<float>(pixels)};
    std::vector<float> hashes;
    for (const std::string& each : rank.names) hashes.push_back(matte_float(each));
    channels[fmt::format("{}{:02}.{}", name, k / 2, components[k % 2 * 2])] = hashes;
    channels[fmt::format("{}{:02}.{}", name, k / 2, components[k % 2 * 2 + 1])] = rank.coverage;
  }
  return channels;
}

/// Metadata of a cryptomatte; without names, it has no manifest.
inline ExrTexts matte_texts(const std::vector<std::string>& names,
                            const std::string& name = "ViewLayer.CryptoObject",
                            const std::string& key = "542cafa") {
  std::string manifest;
  for (const std::string& each : names)
    manifest += fmt::format("{}\"{}\":\"{:08x}\"", manifest.empty() ? "" : ",", each,
                            thermal::cryptomatte_hash(each));
  ExrTexts texts = {{fmt::format("cryptomatte/{}/name", key), name},
                    {fmt::format("cryptomatte/{}/hash", key), "MurmurHash3_32"},
                    {fmt::format("cryptomatte/{}/conversion", key), "uint32_to_float32"}};
  if (!names.empty()) texts[fmt::format("cryptomatte/{}/manifest", key)] = fmt::format("{{{}}}", manifest);
  return texts;
}

/// Writes float channels with attributes of text, in one part.
inline void write_exr_with_texts(const std::filesystem::path& file, int width_px, int height_px,
                                 const ExrChannels& channels, const ExrTexts& texts,
                                 Imf::Compression compression = Imf::ZIP_COMPRESSION) {
  Imf::Header header(width_px, height_px);
  header.compression() = compression;
  for (const auto& [name, text] : texts) header.insert(name, Imf::StringAttribute(text));
  Imf::FrameBuffer buffer;
  for (const auto& [name, pixels] : channels) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    char* const base = reinterpret_cast<char*>(const_cast<float*>(pixels.data()));
    buffer.insert(name, Imf::Slice(Imf::FLOAT, base, sizeof(float),
                                   sizeof(float) * static_cast<std::size_t>(width_px)));
  }
  Imf::OutputFile out(file.c_str(), header);
  out.setFrameBuffer(buffer);
  out.writePixels(height_px);
}
