#include "dataset/clip/frame_faults.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "imaging/frame_converter.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

bool can_convert(const ClipPasses& passes, const PassReader& reader, const FrameConverter& converter,
                 int frame) {
  const auto index = static_cast<std::size_t>(frame);
  if (frame < 0 || index >= passes.manifest.frames.size()) return false;
  try {
    (void)converter.convert(reader.read(file_of(passes, frame), converter.needs()),
                            passes.manifest.frames[index]);
    return true;
  } catch (const DataError&) {
  } catch (const IoError&) {
  }
  return false;
}

}  // namespace

PassReader reader_for(const ClipPasses& passes) {
  const CameraIntrinsics camera = passes_camera(passes.manifest);
  const std::int64_t pixels = std::int64_t{camera.width_px} * camera.height_px;
  if (pixels > passes.limits.pixels) {
    throw DataError(
        fmt::format("{}: {}", passes.folder.string(),
                    fault("size of the passes", fmt::format("{} x {}", camera.width_px, camera.height_px),
                          "px", fmt::format("at most {} pixels (--max-megapixels)", passes.limits.pixels))));
  }
  return PassReader(passes.manifest, passes.limits);
}

Path file_of(const ClipPasses& passes, int frame) {
  Path file = passes.folder / passes.manifest.frames[static_cast<std::size_t>(frame)].file;
  check_is_file(file);
  return file;
}

std::string message_of(const std::exception_ptr& fault) {
  try {
    std::rethrow_exception(fault);
  } catch (const std::exception& error) {
    return error.what();
  }
}

std::string without_name(const std::string& what, const Path& file) {
  for (const std::string& begin : {"cannot read " + file.string() + ": ", file.string() + ": "}) {
    if (what.starts_with(begin)) return what.substr(begin.size());
  }
  return what;
}

SkippedFrame skipped_frame(const ClipPasses& passes, int frame, const std::exception_ptr& fault) {
  const std::string& name = passes.manifest.frames[static_cast<std::size_t>(frame)].file;
  return {.frame_index = frame,
          .file = name,
          .reason = printable(without_name(message_of(fault), passes.folder / name))};
}

std::string no_frame_left(const std::string& first, int count) {
  if (count == 1) return first;
  return fmt::format("{}; its {} other frame{} cannot be converted either", first, count - 1,
                     count == 2 ? "" : "s");
}

bool can_be_mended(const ClipPasses& passes, const ClipTask& task, const MaterialLibrary& materials,
                   const std::vector<SkippedFrame>& skipped) {
  const PassReader reader = reader_for(passes);
  const FrameConverter converter(passes.manifest, materials, task.clip.season, task.settings().sensor,
                                 task.physics, task.settings().distortion);
  return std::any_of(skipped.begin(), skipped.end(), [&](const SkippedFrame& frame) {
    return can_convert(passes, reader, converter, frame.frame_index);
  });
}

}  // namespace thermal
