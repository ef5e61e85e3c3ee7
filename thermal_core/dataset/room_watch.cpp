#include "dataset/room_watch.h"

#include <system_error>

namespace thermal {
namespace {

/// 0 if the file has been removed meanwhile.
std::int64_t size_bytes(const Path& file) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  return error ? 0 : static_cast<std::int64_t>(bytes);
}

}  // namespace

RoomWatch::RoomWatch(const Config& config, const ClipConfig& clip, const Layout& layout, bool pictures,
                     RunMonitor& monitor)
    : id_(clip.id), layout_(layout), monitor_(monitor), room_(room_for(config, clip, pictures)) {
  int there = 0;
  while (there < clip.frames && std::filesystem::exists(layout_.passes(id_) / passes_name(there))) ++there;
  passes_ready(there);
}

void RoomWatch::passes_ready(int frames) {
  const std::lock_guard lock(mutex_);
  while (room_.passes.count < frames)
    room_.passes.add(size_bytes(layout_.passes(id_) / passes_name(room_.passes.count)));
  report();
}

void RoomWatch::pictures_written() {
  const std::lock_guard lock(mutex_);
  const Path folder = layout_.unfinished_clip(id_);
  const std::string name = frame_name(room_.pictures.count);
  room_.pictures.add(size_bytes(folder / "ir8" / name) + size_bytes(folder / "ir16" / name));
  report();
}

void RoomWatch::report() { monitor_.needs(id_, room_.needed_bytes()); }

}  // namespace thermal
