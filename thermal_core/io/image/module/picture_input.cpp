#include "io/image/module/picture_input.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "io/image/module/tiff.h"
#include "io/pass_buffer.h"

namespace thermal::pictures {
namespace {

/// Zstandard, the densest compression, stores 128 kB in 4 bytes.
constexpr std::uint64_t kMostPerByte = 1U << 15U;

struct Claim {
  const char* what;
  int width_px;
  int height_px;
};

void check_fits(const Claim& claim, const OIIO::ImageSpec& spec, std::int64_t most_pixels,
                std::uint64_t file_bytes) {
  const std::int64_t pixels = std::int64_t{claim.width_px} * claim.height_px;
  const bool countable =
      claim.width_px >= 0 && claim.height_px >= 0;  // from 2^31 on, OpenImageIO reports negative ones
  const std::uint64_t bytes = static_cast<std::uint64_t>(pixels) * spec.pixel_bytes(true);
  if (countable && pixels <= most_pixels && bytes / kMostPerByte <= file_bytes) return;
  throw DataError(fmt::format("{} = {} x {} px of {} bytes each; expected what a file of {} bytes can hold",
                              claim.what, claim.width_px, claim.height_px, spec.pixel_bytes(true),
                              file_bytes));
}

/// DataError, without the file's name, for a picture of more pixels than ReadLimits has, or of more bytes than a file
/// of this length can hold, in its pixels or in one of its tiles or strips; and for volumes. To be called before memory
/// is allocated.
void check_claimed_size(const OIIO::ImageSpec& spec, const Path& file) {
  const std::int64_t most_pixels = ReadLimits().pixels;
  const auto pixels = static_cast<std::int64_t>(spec.image_pixels());
  if (pixels < 1 || pixels > most_pixels || spec.depth > 1)
    throw DataError(fmt::format("size = {} x {} x {} px; expected 1 to {} pixels", spec.width, spec.height,
                                spec.depth, most_pixels));
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  if (error) return;  // not a regular file
  // OpenImageIO reserves address space for all rows of a strip, of which 65,535 are usual, even if the picture has
  // fewer.
  const int strip_rows = spec.get_int_attribute("tiff:RowsPerStrip");
  check_fits({"size", spec.width, spec.height}, spec, most_pixels, bytes);
  check_fits({"tiles", spec.tile_width, spec.tile_height}, spec, most_pixels, bytes);
  check_fits({"strips", spec.width, strip_rows}, spec, 4 * most_pixels, bytes);
}

using namespace std::string_view_literals;

/// OpenImageIO's decoder, and the magic bytes of its files.
struct Decoder {
  const char* name;
  std::string_view begins;
};
constexpr std::array<Decoder, 6> kDecoders = {{{"png", "\x89PNG\r\n\x1a\n"sv},
                                               {"jpeg", "\xff\xd8\xff"sv},
                                               {"tiff", "II*\0"sv},
                                               {"tiff", "MM\0*"sv},
                                               {"tiff", "II+\0"sv},  // BigTIFF
                                               {"tiff", "MM\0+"sv}}};

/// Reads regular files only, since opening a pipe would wait for a writer.
std::string first_bytes(const Path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw IoError(fmt::format("cannot read {}: {}", file.string(),
                              std::filesystem::exists(file) ? "no regular file" : "no such file"));
  std::string bytes(8, '\0');
  std::ifstream(file, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

/// Requested by name, so that no other decoder opens the file.
std::unique_ptr<OIIO::ImageInput> decoder_for(const Path& file) {
  const std::string bytes = first_bytes(file);
  for (const Decoder& one : kDecoders)
    if (bytes.starts_with(one.begins)) return OIIO::ImageInput::create(one.name);
  throw DataError("it begins as no PNG, JPEG or TIFF does");
}

}  // namespace

std::unique_ptr<OIIO::ImageInput> open_picture(const Path& file) {
  auto in = decoder_for(file);
  OIIO::ImageSpec spec;
  if (!in || !in->open(file.string(), spec))
    throw DataError(fmt::format("damaged: {}", in ? in->geterror() : OIIO::geterror()));
  check_claimed_size(spec, file);
  return in;
}

void read_channels(OIIO::ImageInput& in, const Path& file, int channels, OIIO::TypeDesc type, void* samples) {
  if (in.format_name() == std::string_view("tiff")) check_is_whole(file);
  if (!in.read_image(0, 0, 0, channels, type, samples))
    throw DataError(fmt::format("damaged: {}", in.geterror()));
}

}  // namespace thermal::pictures
