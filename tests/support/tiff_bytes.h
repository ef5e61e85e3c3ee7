#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

/// A page of a TIFF file: one uncompressed channel.
struct TiffPage {
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  std::uint32_t bits = 32;
  std::uint32_t format = 3;       ///< TIFF's SampleFormat: 1 unsigned, 2 signed, 3 floats
  std::string pixels = {};        ///< little-endian
  std::uint32_t photometric = 1;  ///< 0: white is zero
  std::uint32_t kind = 0;         ///< TIFF's NewSubfileType: 1 a smaller copy, 4 a mask
  std::string metadata = {};      ///< GDAL_METADATA; empty: none
  std::string no_data = {};       ///< GDAL_NODATA; empty: none
};

/// A page of numbers of any type.
template <typename Number>
TiffPage tiff_page(std::uint32_t width_px, std::uint32_t height_px, const std::vector<Number>& values) {
  TiffPage page = {.width_px = width_px, .height_px = height_px, .bits = 8 * sizeof(Number)};
  page.format = std::is_floating_point_v<Number> ? 3 : std::is_signed_v<Number> ? 2 : 1;
  page.pixels.resize(values.size() * sizeof(Number));
  std::memcpy(page.pixels.data(), values.data(), page.pixels.size());
  return page;
}

/// Writes a little-endian TIFF byte by byte, independently of any library.
/// Source: TIFF revision 6.0 (1992), section 2; GDAL's tags 42112 and 42113.
class TiffBytes {
 public:
  TiffBytes& add(const TiffPage& page) {
    static_assert(std::endian::native == std::endian::little);
    entries_.clear();
    add_number(254, page.kind);
    add_number(256, page.width_px);
    add_number(257, page.height_px);
    add_number(258, page.bits);
    add_number(259, 1);
    add_number(262, page.photometric);
    add_number(273, append(page.pixels));
    add_number(277, 1);
    add_number(278, page.height_px);
    add_number(279, static_cast<std::uint32_t>(page.pixels.size()));
    add_number(339, page.format);
    add_text(42112, page.metadata);
    add_text(42113, page.no_data);
    end_page();
    return *this;
  }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  struct Entry {
    std::uint16_t tag, type;
    std::uint32_t count, value;
  };

  static std::string text_of(std::uint32_t number) {
    std::string text(4, '\0');
    std::memcpy(text.data(), &number, 4);
    return text;
  }

  /// Returns where it begins.
  std::uint32_t append(const std::string& content) {
    const auto begin = static_cast<std::uint32_t>(bytes_.size());
    bytes_ += content;
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    return begin;
  }

  void add_number(std::uint16_t tag, std::uint32_t value) { entries_.push_back({tag, 4, 1, value}); }

  void add_text(std::uint16_t tag, std::string text) {
    if (text.empty()) return;
    text += '\0';
    std::uint32_t value = 0;
    if (text.size() <= 4)
      std::memcpy(&value, text.data(), text.size());
    else
      value = append(text);
    entries_.push_back({tag, 2, static_cast<std::uint32_t>(text.size()), value});
  }

  void end_page() {
    bytes_.replace(link_, 4, text_of(static_cast<std::uint32_t>(bytes_.size())));
    const auto count = static_cast<std::uint16_t>(entries_.size());
    bytes_.append(reinterpret_cast<const char*>(&count), 2);
    for (const Entry& entry : entries_) bytes_.append(reinterpret_cast<const char*>(&entry), sizeof(Entry));
    link_ = bytes_.size();
    bytes_.append(4, '\0');
  }

  std::string bytes_ = std::string("II*\0\0\0\0\0", 8);
  std::size_t link_ = 4;
  std::vector<Entry> entries_;
};
