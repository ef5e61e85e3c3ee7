#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

/// A PNG as another program might write it, chunk by chunk and independently of the libraries that read it.
/// Source: ISO/IEC 15948; RFC 1950 and 1951, stored blocks.
struct PngPicture {
  std::uint32_t width_px = 1;
  std::uint32_t height_px = 1;
  int bit_depth = 8;
  int colour_type = 0;       ///< 0 grey, 2 colour, 3 palette, 4 grey and alpha, 6 colour and alpha
  std::string samples = {};  ///< rows as stored, without filter bytes
  std::string palette = {};
  std::string transparency = {};  ///< of the palette's entries
  std::uint32_t gamma_100000 = 0;
  bool interlaced = false;   ///< for pixels of whole bytes
  std::string filters = {};  ///< filter numbers of the rows, repeated; empty: 0
};

namespace png_bytes {

inline std::string big_endian(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(number >> shift));
  return bytes;
}

inline std::string chunk(const std::string& name, const std::string& data) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char byte : name + data) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xEDB88320U : 0U);
  }
  return big_endian(static_cast<std::uint32_t>(data.size())) + name + data + big_endian(~crc);
}

/// Stored, not compressed.
inline std::string zlib_stream(const std::string& data) {
  std::string stream = "\x78\x01";
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char byte : data) {
    a = (a + static_cast<unsigned char>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  constexpr std::size_t kMost = 65535;
  for (std::size_t begin = 0; begin < data.size() || begin == 0; begin += kMost) {
    const std::string block = data.substr(begin, kMost);
    const auto length = static_cast<unsigned>(block.size());
    stream.push_back(begin + kMost >= data.size() ? '\1' : '\0');
    for (const unsigned number : {length, ~length}) {
      stream.push_back(static_cast<char>(number));
      stream.push_back(static_cast<char>(number >> 8));
    }
    stream += block;
  }
  return stream + big_endian(b << 16 | a);
}

inline std::size_t row_bytes(const PngPicture& picture) {
  constexpr std::array<std::size_t, 7> kChannels = {1, 0, 3, 1, 2, 0, 4};
  const std::size_t channels = kChannels.at(static_cast<std::size_t>(picture.colour_type));
  return (picture.width_px * channels * static_cast<std::size_t>(picture.bit_depth) + 7) / 8;
}

/// A row preceded by its filter number. Source: ISO/IEC 15948, 9.
inline std::string filtered(const std::string& row, const std::string& above, std::size_t pixel_bytes,
                            char filter) {
  std::string bytes(1, filter);
  const auto at = [](const std::string& of, std::size_t i) {
    return static_cast<int>(static_cast<unsigned char>(of[i]));
  };
  for (std::size_t i = 0; i < row.size(); ++i) {
    const int a = i >= pixel_bytes ? at(row, i - pixel_bytes) : 0;
    const int b = above.empty() ? 0 : at(above, i);
    const int c = i >= pixel_bytes && !above.empty() ? at(above, i - pixel_bytes) : 0;
    const int p = a + b - c;
    const int pa = std::abs(p - a);
    const int pb = std::abs(p - b);
    const int pc = std::abs(p - c);
    const int paeth = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
    const std::array<int, 5> taken = {0, a, b, (a + b) / 2, paeth};
    bytes.push_back(static_cast<char>(at(row, i) - taken.at(static_cast<std::size_t>(filter))));
  }
  return bytes;
}

/// Rows of one pass over the picture.
inline std::string rows(const PngPicture& picture, std::array<std::size_t, 2> first,
                        std::array<std::size_t, 2> step) {
  std::string data;
  std::string above;
  const std::size_t bytes = row_bytes(picture);
  const std::size_t pixel = std::max<std::size_t>(1, bytes / picture.width_px);
  std::size_t number = 0;
  for (std::size_t y = first[1]; y < picture.height_px && first[0] < picture.width_px; y += step[1]) {
    if (y * bytes >= picture.samples.size()) break;  // a header may claim more than there is
    std::string row;
    if (step[0] == 1) row = picture.samples.substr(y * bytes, bytes);
    for (std::size_t x = first[0]; step[0] > 1 && x < picture.width_px; x += step[0])
      row += picture.samples.substr(y * bytes + x * pixel, pixel);
    const char filter = picture.filters.empty() ? '\0' : picture.filters[number++ % picture.filters.size()];
    data += filtered(row, above, pixel, filter);
    above = row;
  }
  return data;
}

inline std::string all_rows(const PngPicture& picture) {
  if (!picture.interlaced) return rows(picture, {0, 0}, {1, 1});
  std::string data;
  data += rows(picture, {0, 0}, {8, 8}) + rows(picture, {4, 0}, {8, 8}) + rows(picture, {0, 4}, {4, 8});
  data += rows(picture, {2, 0}, {4, 4}) + rows(picture, {0, 2}, {2, 4}) + rows(picture, {1, 0}, {2, 2});
  return data + rows(picture, {0, 1}, {1, 2});
}

/// `stream` replaces the picture's own pixels, unless empty.
inline std::string encode(const PngPicture& picture, const std::string& stream = "") {
  std::string head = big_endian(picture.width_px) + big_endian(picture.height_px);
  head += {static_cast<char>(picture.bit_depth), static_cast<char>(picture.colour_type), '\0', '\0',
           static_cast<char>(picture.interlaced)};
  std::string bytes = "\x89PNG\r\n\x1A\n" + chunk("IHDR", head);
  if (picture.gamma_100000 != 0) bytes += chunk("gAMA", big_endian(picture.gamma_100000));
  if (!picture.palette.empty()) bytes += chunk("PLTE", picture.palette);
  if (!picture.transparency.empty()) bytes += chunk("tRNS", picture.transparency);
  return bytes + chunk("IDAT", stream.empty() ? zlib_stream(all_rows(picture)) : stream) + chunk("IEND", "");
}

}  // namespace png_bytes
