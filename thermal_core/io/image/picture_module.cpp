#include "io/image/picture_module.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

#include <dlfcn.h>
#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/image/index_picture.h"
#include "io/image/pictures.h"
#include "io/system/files.h"

namespace thermal {
namespace {

/// In ../lib/veldt from the program, built or installed. Loaded by its path, because under AddressSanitizer the loader
/// ignores the program's run path. It is never unloaded.
const PictureModule& load() {
  const Path program = std::filesystem::read_symlink("/proc/self/exe");
  const Path file = program.parent_path().parent_path() / "lib" / "veldt" / "libveldt_pictures.so";
  void* library = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  void* table = library == nullptr ? nullptr : ::dlsym(library, "kVeldtPictureModule");
  if (table == nullptr) throw IoError(fmt::format("cannot load a part of veldt: {}", ::dlerror()));
  return *static_cast<const PictureModule*>(table);
}

}  // namespace

const PictureModule& picture_module() {
  static const PictureModule& module = load();
  return module;
}

std::string as_jpeg(const Path& picture, int most_px) {
  return naming(picture, [&] { return picture_module().as_jpeg(picture, most_px); });
}

PictureSize read_picture_size(const Path& file) { return picture_module().read_picture_size(file); }

PhotoTags read_photo_tags(const Path& file) {
  return naming(file, [&] { return picture_module().read_tags(file); });
}

std::string encode_picture(const cv::Mat& bgr, PictureFormat format) {
  return picture_module().encode_picture(bgr, format);
}

std::string encode_tiff(const Plane<float>& picture, const TiffTags& tags) {
  return picture_module().encode_kelvin_tiff(picture, tags);
}

std::string encode_tiff(const Plane<std::uint16_t>& picture, const TiffTags& tags) {
  return picture_module().encode_counts_tiff(picture, tags);
}

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

namespace {

/// Replaces each UTF-8 character that is not printable ASCII by "?".
std::string ascii_of(std::string_view text) {
  std::string ascii;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool inner = (byte & 0xC0U) == 0x80U;  // continuation byte
    if (!inner) ascii += byte >= ' ' && byte < 0x7F ? c : '?';
  }
  return ascii;
}

}  // namespace

TextPicture draw_text(const Path& font, const std::string& line, int size_px) {
  check_is_file(font);
  const std::string text = ascii_of(line);
  if (text.find_first_not_of(' ') == std::string::npos) return {};
  return picture_module().draw_text(font, text, size_px);
}

}  // namespace thermal
