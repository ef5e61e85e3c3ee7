#include "io/exr/passes_writer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <new>
#include <span>
#include <vector>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include "base/error.h"
#include "scene/passes.h"

namespace thermal {
namespace {

/// By channel.
using Planes = std::map<std::string, Plane<float>>;

Plane<float> as_floats(const Plane<std::uint16_t>& indices) {
  Plane<float> plane(indices.width_px(), indices.height_px());
  for (std::size_t i = 0; i < plane.size(); ++i) plane.pixels()[i] = indices.pixels()[i];
  return plane;
}

Planes planes_of(const Passes& passes, const std::string& layer, const std::string& actor_layer) {
  if (passes.fine.factor > 1) {
    Planes planes = planes_of(filled_in(passes), layer, actor_layer);
    planes.emplace(fmt::format("{}.{}.X", layer, kSampledPass),
                   as_floats(sampled_mask(passes.fine, passes.object_index.width_px())));
    return planes;
  }
  Planes planes = {{layer + ".IndexOB.X", as_floats(passes.object_index)},
                   {layer + ".IndexMA.X", as_floats(passes.material_index)},
                   {layer + ".Depth.Z", passes.depth_m},
                   {layer + ".Normal.X", passes.normal[0]},
                   {layer + ".Normal.Y", passes.normal[1]},
                   {layer + ".Normal.Z", passes.normal[2]},
                   {actor_layer + ".IndexOB.X", as_floats(passes.actor_index)}};
  const std::string mirror(kMirrorLayer);
  planes.emplace(mirror + ".IndexOB.X", as_floats(passes.mirrored.object_index));
  planes.emplace(mirror + ".IndexMA.X", as_floats(passes.mirrored.material_index));
  planes.emplace(mirror + ".Depth.Z", passes.mirrored.depth_m);
  planes.emplace(mirror + ".Normal.X", passes.mirrored.normal[0]);
  planes.emplace(mirror + ".Normal.Y", passes.mirrored.normal[1]);
  planes.emplace(mirror + ".Normal.Z", passes.mirrored.normal[2]);
  std::erase_if(planes, [](const auto& entry) { return entry.second.empty(); });
  return planes;
}

/// A file in memory. OpenEXR writes its table of offsets in a destructor, and would not report a disk error there.
class MemoryFile : public Imf::OStream {
 public:
  explicit MemoryFile(const Path& name) : Imf::OStream(name.c_str()) {}

  void write(const char bytes[], int count) override {  // NOLINT(modernize-avoid-c-arrays): OpenEXR's
    const std::size_t end = place_ + static_cast<std::size_t>(count);
    if (content_.size() < end) content_.resize(end);
    std::copy_n(bytes, count, content_.begin() + static_cast<std::ptrdiff_t>(place_));
    place_ = end;
  }
  std::uint64_t tellp() override { return place_; }
  void seekp(std::uint64_t place) override { place_ = place; }

  [[nodiscard]] std::span<const char> content() const noexcept { return content_; }

 private:
  std::vector<char> content_;
  std::size_t place_ = 0;
};

void encode(Planes planes, ExrPacking packing, MemoryFile& out) {
  const Plane<float>& first = planes.begin()->second;
  Imf::Header header(first.width_px(), first.height_px());
  header.compression() = packing == ExrPacking::none ? Imf::NO_COMPRESSION : Imf::RLE_COMPRESSION;
  Imf::FrameBuffer buffer;
  for (auto& [name, plane] : planes) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    buffer.insert(name,
                  Imf::Slice::Make(Imf::FLOAT, plane.pixels().data(), header.dataWindow(), sizeof(float)));
  }
  Imf::OutputFile file(out, header, 0);  // no threads of its own
  file.setFrameBuffer(buffer);
  file.writePixels(first.height_px());
}

/// Writes a file under a temporary name, which a killed run may have left, and renames it.
void put(const Path& file, std::span<const char> content) {
  const Path part = file.parent_path() / ("part_" + file.filename().string());
  std::error_code error;
  std::filesystem::remove(part, error);
  try {
    write_file(part, std::as_bytes(content));
    std::filesystem::rename(part, file, error);
    if (error) fail_at("rename to", file, error.value());
  } catch (...) {
    std::filesystem::remove(part, error);
    throw;
  }
}

}  // namespace

void write_passes(const Path& file, const Passes& passes, const std::string& layer,
                  const std::string& actor_layer, ExrPacking packing) {
  MemoryFile content(file);
  try {
    encode(planes_of(passes, layer, actor_layer), packing, content);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw IoError(fmt::format("cannot write {}: {}", file.string(), error.what()));
  }
  put(file, content.content());
}

}  // namespace thermal
