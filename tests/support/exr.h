#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>

/// Channels of an EXR file by name, each with its pixels row by row.
using ExrChannels = std::map<std::string, std::vector<float>>;

/// Writes a single-part EXR file as another renderer might. `type` is how the pixels are stored.
inline void write_exr(const std::filesystem::path& file, int width_px, int height_px,
                      const ExrChannels& channels, Imf::PixelType type = Imf::FLOAT,
                      Imf::Compression compression = Imf::ZIP_COMPRESSION) {
  Imf::Header header(width_px, height_px);
  header.compression() = compression;
  Imf::FrameBuffer buffer;
  std::map<std::string, std::vector<char>> stored;
  const std::size_t bytes = type == Imf::HALF ? 2 : 4;
  for (const auto& [name, pixels] : channels) {
    header.channels().insert(name, Imf::Channel(type));
    std::vector<char>& data = stored[name];
    data.resize(pixels.size() * bytes);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (type == Imf::HALF) reinterpret_cast<half*>(data.data())[i] = half(pixels[i]);
      if (type == Imf::FLOAT) reinterpret_cast<float*>(data.data())[i] = pixels[i];
      if (type == Imf::UINT)
        reinterpret_cast<std::uint32_t*>(data.data())[i] = static_cast<std::uint32_t>(pixels[i]);
    }
    buffer.insert(name, Imf::Slice(type, data.data(), bytes, bytes * static_cast<std::size_t>(width_px)));
  }
  Imf::OutputFile out(file.c_str(), header);
  out.setFrameBuffer(buffer);
  out.writePixels(height_px);
}
