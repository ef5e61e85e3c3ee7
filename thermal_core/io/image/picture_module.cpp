#include "io/image/picture_module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "base/error.h"
#include "io/image/jpeg.h"
#include "io/system/naming.h"

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

}  // namespace thermal
