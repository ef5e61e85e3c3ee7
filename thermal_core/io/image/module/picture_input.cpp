#include "io/image/module/picture_input.h"

#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "io/image/module/claimed_size.h"
#include "io/image/module/tiff_library.h"

namespace thermal::pictures {

std::unique_ptr<OIIO::ImageInput> open_picture(const Path& file) {
  auto in = OIIO::ImageInput::open(file.string());
  if (!in) throw DataError(fmt::format("damaged: {}", OIIO::geterror()));
  check_claimed_size(in->spec(), file);
  return in;
}

void read_channels(OIIO::ImageInput& in, const Path& file, int channels, OIIO::TypeDesc type, void* samples) {
  if (in.format_name() == std::string_view("tiff")) check_is_whole(file);
  if (!in.read_image(0, 0, 0, channels, type, samples))
    throw DataError(fmt::format("damaged: {}", in.geterror()));
}

}  // namespace thermal::pictures
