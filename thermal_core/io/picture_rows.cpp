#include "io/picture_rows.h"

#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {
namespace {

/// Splits stored rows into samples.
class Pixels {
 public:
  explicit Pixels(const PngFile& file) : header_(file.header()), colours_(file.colours()) {}

  [[nodiscard]] PicturePixel at(std::span<const std::uint8_t> row, std::size_t x) const {
    if (header_.palette) return of_palette(row[x]);
    const std::size_t channels = header_.channels();
    PicturePixel pixel;
    bool is_clear = colours_.clear.has_value();
    for (std::size_t c = 0; c < (header_.colour ? 3U : 1U); ++c) {
      const std::uint16_t value = sample(row, x * channels + c);
      is_clear = is_clear && value == (*colours_.clear)[c];
      if (header_.colour) pixel.colour[c] = static_cast<std::uint8_t>(value);
      if (!header_.colour) pixel.grey = value;
    }
    pixel.alpha = header_.alpha ? sample(row, x * channels + channels - 1) : opaque();
    if (is_clear) pixel.alpha = 0;
    return pixel;
  }

 private:
  [[nodiscard]] std::uint16_t opaque() const noexcept { return header_.bit_depth == 16 ? 0xFFFF : 0xFF; }

  [[nodiscard]] std::uint16_t sample(std::span<const std::uint8_t> row, std::size_t number) const noexcept {
    if (header_.bit_depth != 16) return row[number];
    std::uint16_t value = 0;
    std::memcpy(&value, &row[2 * number], sizeof(value));
    return value;
  }

  [[nodiscard]] PicturePixel of_palette(std::size_t entry) const {
    const std::vector<Colour>& palette = colours_.palette;
    if (entry >= palette.size())
      throw DataError(fault("damaged: a pixel's colour", fmt::format("{}", entry), "",
                            fmt::format("one of the {} of its palette", palette.size())));
    const std::vector<std::uint8_t>& alphas = colours_.alphas;
    const std::uint16_t alpha = entry < alphas.size() ? alphas[entry] : 0xFF;
    return {.grey = 0, .colour = palette[entry], .alpha = alpha};
  }

  PngHeader header_;
  PngColours colours_;
};

}  // namespace

PictureKind kind_of(const PngHeader& header) {
  if (!header.colour) return header.bit_depth == 16 ? PictureKind::grey16 : PictureKind::grey8;
  if (header.bit_depth <= 8) return PictureKind::colour;
  throw DataError(
      fault("bits per channel", fmt::format("{}", header.bit_depth), "", "8 in a picture of colours"));
}

void read_rows(PngFile& file, const TakeRow& take) {
  const Pixels pixels(file);
  std::vector<PicturePixel> row(file.header().width_px);
  file.read([&](int y, std::span<const std::uint8_t> stored) {
    for (std::size_t x = 0; x < row.size(); ++x) row[x] = pixels.at(stored, x);
    take(y, row);
  });
}

}  // namespace thermal
