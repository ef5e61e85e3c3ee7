#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfTileDescription.h>
#include <ImfTiledOutputPart.h>

/// EXR files in every form of the format: several parts, tiles and levels, windows, line orders, mixed types.
namespace exr_forms {

/// Pixels as they are stored, row by row.
struct Stored {
  Imf::PixelType type = Imf::FLOAT;
  std::vector<char> bytes;
};

template <typename Pixel>
Stored stored(Imf::PixelType type, const std::vector<Pixel>& pixels) {
  Stored plane{.type = type, .bytes = std::vector<char>(pixels.size() * sizeof(Pixel))};
  std::memcpy(plane.bytes.data(), pixels.data(), plane.bytes.size());
  return plane;
}

inline Stored floats(const std::vector<float>& pixels) { return stored(Imf::FLOAT, pixels); }
inline Stored wholes(const std::vector<std::uint32_t>& pixels) { return stored(Imf::UINT, pixels); }
inline Stored halves(const std::vector<float>& pixels) {
  std::vector<std::uint16_t> bits;
  for (const float pixel : pixels) bits.push_back(half(pixel).bits());
  return stored(Imf::HALF, bits);
}

/// The same numbers, whatever the type.
inline Stored numbers(Imf::PixelType type, const std::vector<float>& pixels) {
  if (type == Imf::HALF) return halves(pixels);
  if (type == Imf::FLOAT) return floats(pixels);
  return wholes(std::vector<std::uint32_t>(pixels.begin(), pixels.end()));
}

struct Part {
  Imath::Box2i display;
  std::optional<Imath::Box2i> data = {};        ///< if it is not the display window
  std::map<std::string, Stored> channels = {};  ///< pixels of the data window
  std::string name = {};
  std::string view = {};
  Imf::Compression compression = Imf::ZIP_COMPRESSION;
  Imf::LineOrder order = Imf::INCREASING_Y;
  std::optional<Imf::TileDescription> tiles = {};
  float pixel_aspect = 1;
  std::optional<Imf::Envmap> environment = {};
  int lines = -1;  ///< that get written, of scanlines; -1: all

  [[nodiscard]] Imath::Box2i window() const { return data.value_or(display); }
};

inline Imath::Box2i window(int left, int top, int width_px, int height_px) {
  return {{left, top}, {left + width_px - 1, top + height_px - 1}};
}

inline std::size_t width_of(const Imath::Box2i& box) {
  return static_cast<std::size_t>(box.max.x - box.min.x + 1);
}
inline int height_of(const Imath::Box2i& box) { return box.max.y - box.min.y + 1; }

inline Imf::Header header_of(const Part& part) {
  Imf::Header header(part.display, part.window());
  header.compression() = part.compression;
  header.lineOrder() = part.order;
  header.setType(part.tiles ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
  if (!part.name.empty()) header.setName(part.name);
  if (!part.view.empty()) header.setView(part.view);
  header.pixelAspectRatio() = part.pixel_aspect;
  if (part.environment) Imf::addEnvmap(header, *part.environment);
  if (part.tiles) header.setTileDescription(*part.tiles);
  for (const auto& [name, plane] : part.channels) header.channels().insert(name, Imf::Channel(plane.type));
  return header;
}

inline Imf::FrameBuffer buffer_of(const Part& part) {
  Imf::FrameBuffer buffer;
  for (const auto& [name, plane] : part.channels) {
    const std::size_t bytes = plane.type == Imf::HALF ? 2 : 4;
    buffer.insert(name, Imf::Slice::Make(plane.type, plane.bytes.data(), part.window(), bytes,
                                         bytes * width_of(part.window())));
  }
  return buffer;
}

/// Coarser levels hold other values, so that reading them would be noticed.
inline Part coarser(Part part) {
  for (auto& [name, plane] : part.channels) std::fill(plane.bytes.begin(), plane.bytes.end(), '\x45');
  return part;
}

inline void write_level(Imf::TiledOutputPart& out, const Part& part, int lx, int ly) {
  const Part pixels = lx + ly == 0 ? part : coarser(part);
  out.setFrameBuffer(buffer_of(pixels));
  for (int y = out.numYTiles(ly); y-- > 0;) {
    if (part.order != Imf::RANDOM_Y) continue;
    for (int x = out.numXTiles(lx); x-- > 0;) out.writeTile(x, y, lx, ly);  // the last first
  }
  if (part.order != Imf::RANDOM_Y) out.writeTiles(0, out.numXTiles(lx) - 1, 0, out.numYTiles(ly) - 1, lx, ly);
}

inline void write_tiles(Imf::MultiPartOutputFile& file, int number, const Part& part) {
  Imf::TiledOutputPart out(file, number);
  for (int ly = 0; ly < out.numYLevels(); ++ly) {
    for (int lx = 0; lx < out.numXLevels(); ++lx) {
      if (out.isValidLevel(lx, ly)) write_level(out, part, lx, ly);
    }
  }
}

inline void write_lines(Imf::MultiPartOutputFile& file, int number, const Part& part) {
  Imf::OutputPart out(file, number);
  out.setFrameBuffer(buffer_of(part));
  out.writePixels(part.lines >= 0 ? part.lines : height_of(part.window()));
}

/// One part makes an ordinary file.
inline void write(const std::filesystem::path& file, const std::vector<Part>& parts) {
  std::vector<Imf::Header> headers;
  for (const Part& part : parts) headers.push_back(header_of(part));
  Imf::MultiPartOutputFile out(file.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (int number = 0; number < static_cast<int>(parts.size()); ++number) {
    const Part& part = parts[static_cast<std::size_t>(number)];
    part.tiles ? write_tiles(out, number, part) : write_lines(out, number, part);
  }
}

}  // namespace exr_forms
