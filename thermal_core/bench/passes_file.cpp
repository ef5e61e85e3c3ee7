#include "bench/passes_file.h"

#include <map>
#include <string>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include "base/error.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

Plane<float> as_floats(const Plane<std::uint16_t>& indices) {
  Plane<float> plane(indices.width_px(), indices.height_px());
  for (std::size_t i = 0; i < plane.size(); ++i) plane.pixels()[i] = indices.pixels()[i];
  return plane;
}

template <typename T>
Plane<T> enlarged_plane(const Plane<T>& plane, int factor) {
  Plane<T> large(plane.width_px() * factor, plane.height_px() * factor);
  if (plane.empty()) return large;
  for (int y = 0; y < large.height_px(); ++y) {
    for (int x = 0; x < large.width_px(); ++x) large.at(x, y) = plane.at(x / factor, y / factor);
  }
  return large;
}

}  // namespace

void write_passes(const Path& file, const Passes& passes) {
  const std::map<std::string, Plane<float>> planes = {{"Scene.IndexOB.X", as_floats(passes.object_index)},
                                                      {"Scene.IndexMA.X", as_floats(passes.material_index)},
                                                      {"Scene.Depth.Z", passes.depth_m},
                                                      {"Scene.Normal.X", passes.normal[0]},
                                                      {"Scene.Normal.Y", passes.normal[1]},
                                                      {"Scene.Normal.Z", passes.normal[2]}};
  Imf::Header header(passes.object_index.width_px(), passes.object_index.height_px());
  header.compression() = Imf::NO_COMPRESSION;
  Imf::FrameBuffer buffer;
  for (const auto& [name, plane] : planes) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    // A frame buffer also serves for reading, so it takes no pointer to const.
    float* const pixels =
        const_cast<float*>(plane.pixels().data());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
    buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, pixels, header.dataWindow(), sizeof(float)));
  }
  try {
    Imf::OutputFile out(file.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(passes.object_index.height_px());
  } catch (const std::exception& error) {
    throw IoError(fmt::format("cannot write {}: {}", file.string(), error.what()));
  }
}

BenchScene enlarged(const BenchScene& scene, int factor) {
  BenchScene large{.manifest = scene.manifest, .passes = {}};
  large.manifest.camera = finer(scene.manifest.camera, factor);
  large.passes.object_index = enlarged_plane(scene.passes.object_index, factor);
  large.passes.material_index = enlarged_plane(scene.passes.material_index, factor);
  large.passes.depth_m = enlarged_plane(scene.passes.depth_m, factor);
  for (std::size_t axis = 0; axis < 3; ++axis)
    large.passes.normal[axis] = enlarged_plane(scene.passes.normal[axis], factor);
  return large;
}

}  // namespace thermal
