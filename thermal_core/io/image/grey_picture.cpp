#include "io/image/grey_picture.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "base/text.h"
#include "io/image/index_picture.h"
#include "io/image/picture_module.h"
#include "io/system/naming.h"

namespace thermal {
namespace {

std::string extension_of(const Path& file) { return lower_case(file.extension().string()); }

std::uint16_t grey_of(const PicturePixel& pixel) {
  const auto [least, most] = std::minmax_element(pixel.colour.begin(), pixel.colour.end());
  if (*most - *least > kMostGreyTint) throw DataError(fault("pixels", "colours", "", "grey levels"));
  return pixel.colour[0];
}

GreyPicture read_png(const Path& path) {
  PngFile file(path);
  const PngHeader& header = file.header();
  check_plausible(header, ReadLimits().pixels);
  const PictureKind kind = kind_of(header);
  if (!header.colour && header.bit_depth < 8)
    throw DataError(fault("pixels", std::to_string(header.bit_depth), "bits", "grey of 8 or 16 bits"));
  GreyPicture picture = {
      .levels = Plane<std::uint16_t>(static_cast<int>(header.width_px), static_cast<int>(header.height_px)),
      .bits = kind == PictureKind::grey16 ? 16 : 8};
  read_rows(file, [&](int y, std::span<const PicturePixel> row) {
    std::transform(row.begin(), row.end(), picture.levels.row(y).begin(), [kind](const PicturePixel& pixel) {
      return kind == PictureKind::colour ? grey_of(pixel) : pixel.grey;
    });
  });
  return picture;
}

}  // namespace

bool is_grey_picture(const Path& file) {
  constexpr std::array kExtensions = {".png", ".jpg", ".jpeg", ".tif", ".tiff"};
  return std::find(kExtensions.begin(), kExtensions.end(), extension_of(file)) != kExtensions.end();
}

GreyPicture read_grey_picture(const Path& file) {
  check_is_file(file);
  return naming(file, [&file] {
    return extension_of(file) == ".png" ? read_png(file) : picture_module().read_grey(file);
  });
}

}  // namespace thermal
