#include "io/exr_window.h"

#include <exception>

#include <ImfHeader.h>
#include <ImfMultiPartInputFile.h>
#include <fmt/format.h>

#include "base/error.h"

namespace thermal {

ExrWindow read_data_window(const Path& file, const ExrLimits& limits) {
  try {
    check_exr_headers(file, limits);
    const Imf::MultiPartInputFile opened(file.c_str(), 1);
    const Imath::Box2i& picture = opened.header(0).displayWindow();
    const Imath::Box2i& data = opened.header(0).dataWindow();
    return {.x_px = data.min.x - picture.min.x,
            .y_px = data.min.y - picture.min.y,
            .width_px = data.max.x - data.min.x + 1,
            .height_px = data.max.y - data.min.y + 1};
  } catch (const std::exception& error) {
    throw IoError(fmt::format("cannot read {}: {}", file.string(), error.what()));
  }
}

}  // namespace thermal
