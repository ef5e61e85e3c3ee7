#include "io/exr/passes_writer.h"

#include <cstdint>
#include <map>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include "base/error.h"

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
  Planes planes = {{layer + ".IndexOB.X", as_floats(passes.object_index)},
                   {layer + ".IndexMA.X", as_floats(passes.material_index)},
                   {layer + ".Depth.Z", passes.depth_m},
                   {layer + ".Normal.X", passes.normal[0]},
                   {layer + ".Normal.Y", passes.normal[1]},
                   {layer + ".Normal.Z", passes.normal[2]},
                   {actor_layer + ".IndexOB.X", as_floats(passes.actor_index)}};
  std::erase_if(planes, [](const auto& entry) { return entry.second.empty(); });
  return planes;
}

void write(const Path& file, Planes planes, ExrPacking packing) {
  const Plane<float>& first = planes.begin()->second;
  Imf::Header header(first.width_px(), first.height_px());
  header.compression() = packing == ExrPacking::none ? Imf::NO_COMPRESSION : Imf::RLE_COMPRESSION;
  Imf::FrameBuffer buffer;
  for (auto& [name, plane] : planes) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    buffer.insert(name,
                  Imf::Slice::Make(Imf::FLOAT, plane.pixels().data(), header.dataWindow(), sizeof(float)));
  }
  Imf::OutputFile out(file.c_str(), header, 0);  // no threads of its own
  out.setFrameBuffer(buffer);
  out.writePixels(first.height_px());
}

}  // namespace

void write_passes(const Path& file, const Passes& passes, const std::string& layer,
                  const std::string& actor_layer, ExrPacking packing) {
  const Path part = file.parent_path() / ("part_" + file.filename().string());
  try {
    write(part, planes_of(passes, layer, actor_layer), packing);
    std::filesystem::rename(part, file);
  } catch (const std::exception& error) {
    const std::string message = fmt::format("cannot write {}: {}", file.string(), error.what());
    std::error_code none;
    std::filesystem::remove(part, none);
    if (is_disk_full(file.parent_path())) throw TryAgainError(message + "; the disk is full");
    throw IoError(message);
  }
}

}  // namespace thermal
