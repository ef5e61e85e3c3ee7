#include "io/image/module/picture_input.h"

#include <array>
#include <fstream>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "io/image/module/claimed_size.h"
#include "io/image/module/tiff_library.h"

namespace thermal::pictures {
namespace {

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
