#include "io/pass_reader.h"

#include <optional>
#include <utility>

#include "io/exr/cryptomatte.h"
#include "io/exr/passes.h"
#include "io/image/index_picture.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

ExrLayout layout_of(const Manifest& manifest, const ReadLimits& limits) {
  const CameraIntrinsics camera = passes_camera(manifest);
  return {.layer = manifest.layer,
          .actor_layer = manifest.actor_layer,
          .mirror_layer = manifest.mirror_layer,
          .channels = manifest.channels,
          .supersample = manifest.supersample,
          .width_px = camera.width_px,
          .height_px = camera.height_px,
          .pixel_aspect = camera.fy_px / camera.fx_px,
          .limits = {.pixels = limits.pixels}};
}

}  // namespace

struct PassReader::Tables {
  Tables(const Manifest& manifest, const ReadLimits& limits)
      : layout(layout_of(manifest, limits)), pictures(manifest, limits) {
    if (!manifest.cryptomatte.empty()) mattes.emplace(manifest);
  }

  ExrLayout layout;
  IndexPictures pictures;
  std::optional<MatteTable> mattes;  ///< empty: EXR files have an index plane
};

PassReader::PassReader(const Manifest& manifest, const ReadLimits& limits)
    : tables_(std::make_unique<const Tables>(manifest, limits)) {}
PassReader::~PassReader() = default;
PassReader::PassReader(PassReader&&) noexcept = default;
PassReader& PassReader::operator=(PassReader&&) noexcept = default;

Passes PassReader::read(const Path& file, const PassNeeds& needs) const {
  PassBuffer buffer;
  read(file, needs, buffer);
  return std::move(buffer.passes);
}

void PassReader::read(const Path& file, const PassNeeds& needs, PassBuffer& out) const {
  if (is_index_picture(file)) {
    out.passes = tables_->pictures.read(file, needs);
  } else if (tables_->mattes) {
    out.passes = tables_->mattes->read(file, tables_->layout, needs);
  } else {
    read_passes(file, tables_->layout, needs, out);
  }
}

PassNeeds PassReader::planes_in(const Path& file) const {
  if (is_index_picture(file)) return {};
  if (tables_->mattes) return tables_->mattes->planes_in(file, tables_->layout);
  return planes_in_exr(file, tables_->layout);
}

}  // namespace thermal
