#include "io/picture_size.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "base/error.h"

namespace thermal {

PictureSize read_picture_size(const Path& file) {
  const auto in = OIIO::ImageInput::open(file.string());
  if (!in) throw IoError(fmt::format("cannot read {}: {}", file.string(), OIIO::geterror()));
  return {.width_px = in->spec().width, .height_px = in->spec().height};
}

}  // namespace thermal
