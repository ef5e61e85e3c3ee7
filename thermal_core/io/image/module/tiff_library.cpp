#include "io/image/module/tiff_library.h"

#include <array>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"

namespace thermal::pictures {
namespace {

int keep_reason(TIFF*, void* reason, const char*, const char* format, va_list arguments) {
  std::array<char, 256> text{};
  (void)std::vsnprintf(text.data(), text.size(), format, arguments);
  *static_cast<std::string*>(reason) = text.data();
  return 1;
}

int say_nothing(TIFF*, void*, const char*, const char*, va_list) { return 1; }

bool can_decode_all(TIFF* tiff) {
  constexpr tmsize_t kWhole = -1;
  const bool tiled = TIFFIsTiled(tiff) != 0;
  const std::uint32_t pieces = tiled ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
  std::vector<std::byte> piece(static_cast<std::size_t>(tiled ? TIFFTileSize(tiff) : TIFFStripSize(tiff)));
  for (std::uint32_t k = 0; k < pieces; ++k) {
    const tmsize_t bytes = tiled ? TIFFReadEncodedTile(tiff, k, piece.data(), kWhole)
                                 : TIFFReadEncodedStrip(tiff, k, piece.data(), kWhole);
    if (bytes < 0) return false;
  }
  return true;
}

}  // namespace

TiffOptions quiet_options(std::string& reason) {
  TiffOptions options(TIFFOpenOptionsAlloc(), &TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_reason, &reason);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), say_nothing, nullptr);
  return options;
}

Tiff open_tiff(const Path& file, std::string& reason) {
  const TiffOptions options = quiet_options(reason);
  return {TIFFOpenExt(file.c_str(), "r", options.get()), &TIFFClose};
}

void check_is_whole(const Path& file) {
  std::string reason;
  const Tiff tiff = open_tiff(file, reason);
  if (!tiff || !can_decode_all(tiff.get())) throw DataError(fmt::format("damaged: {}", reason));
}

void check_is_single(const Path& file) {
  constexpr int kMostCopies = 64;  // each half as large
  std::string reason;
  const Tiff tiff = open_tiff(file, reason);
  for (int k = 0; tiff && k < kMostCopies && TIFFReadDirectory(tiff.get()) == 1; ++k) {
    std::uint32_t kind = 0;
    (void)TIFFGetField(tiff.get(), TIFFTAG_SUBFILETYPE, &kind);
    if ((kind & FILETYPE_MASK) != 0)
      throw DataError("has a mask of pixels without a value; expected a picture of all pixels");
    if ((kind & FILETYPE_REDUCEDIMAGE) == 0)
      throw DataError("has several pages; expected one picture in each file");
  }
}

}  // namespace thermal::pictures
