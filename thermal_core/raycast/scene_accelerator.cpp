#include "raycast/scene_accelerator.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/parallel.h"
#include "raycast/vertex_normals.h"

namespace thermal {
namespace {

/// Robust: no ray slips through between two triangles that share an edge.
EmbreeScene new_scene(RTCDevice device) {
  EmbreeScene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  return scene;
}

/// Isolated: while it waits, Embree would otherwise take on work of this thread's caller; and the scene would keep a
/// task group of the caller's loop, which oneTBB reads at any later cancellation, after the loop has ended.
void commit(RTCDevice device, RTCScene scene) {
  run_apart([scene] { rtcCommitScene(scene); });
  check_device(device);
}

/// Whether Embree can transform rays into a piece's axes: it ends the program where that gives NaN or huge numbers.
/// Bodies and plants of a plan are far from these limits.
bool can_be_entered(const Transform<double>& m) noexcept {
  constexpr double kLeastVolume = 1e-6;  // of a box with sides as long; several roundings of 6e-8
  constexpr double kLargestInverse = 1e8;
  constexpr double kFarthestPieceM = 1e9;
  const Vector3 x{m[0], m[4], m[8]};
  const Vector3 y{m[1], m[5], m[9]};
  const Vector3 z{m[2], m[6], m[10]};
  const double volume = std::abs(dot(x, cross(y, z)));
  const double widest = std::max({length(cross(x, y)), length(cross(y, z)), length(cross(z, x))});
  return volume > kLeastVolume * length(x) * length(y) * length(z) && widest < kLargestInverse * volume &&
         length({m[3], m[7], m[11]}) < kFarthestPieceM;
}

template <typename Number>
void fill_buffer(RTCDevice device, RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                 std::span<const std::array<Number, 3>> values) {
  auto* buffer = static_cast<Number*>(
      rtcSetNewGeometryBuffer(geometry, type, 0, format, 3 * sizeof(Number), values.size()));
  check_device(device);
  for (const auto& value : values) buffer = std::copy(value.begin(), value.end(), buffer);
}

/// Builds a tree by Morton order, in a third of the time. Triangles of ground are evenly distributed, so rays find them
/// as fast as in a tree built by costs.
void build_fast(RTCGeometry geometry, RTCScene scene) {
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_LOW);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
  rtcSetSceneFlags(scene, rtcGetSceneFlags(scene) | RTC_SCENE_FLAG_DYNAMIC);  // others ignore the quality
}

EmbreeScene scene_of(RTCDevice device, const BakedMesh& mesh, RTCFilterFunctionN filter, bool is_even) {
  const EmbreeGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  // Copies, because Embree also reads the four bytes behind the last point.
  fill_buffer(device, geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.points_m);
  fill_buffer(device, geometry.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
  rtcSetGeometryIntersectFilterFunction(geometry.get(), filter);
  EmbreeScene scene = new_scene(device);
  if (is_even) build_fast(geometry.get(), scene.get());
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene.get(), geometry.get());
  commit(device, scene.get());
  return scene;
}

/// A plant's transform as Blender stores it: angle and size in single precision.
Transform<double> upright(const Transform<double>& plant) noexcept {
  Transform<double> rounded = plant;
  const double size = plant[10];
  for (const std::size_t entry : {0U, 1U, 4U, 5U})
    rounded[entry] = static_cast<double>(static_cast<float>(plant[entry] / size)) * size;
  return rounded;
}

MeshBox box_of(const BakedMesh& mesh) noexcept {
  if (mesh.points_m.empty()) return {};
  std::array<float, 3> least = mesh.points_m.front();
  std::array<float, 3> most = least;
  for (const auto& point : mesh.points_m) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      least.at(axis) = std::min(least.at(axis), point.at(axis));
      most.at(axis) = std::max(most.at(axis), point.at(axis));
    }
  }
  MeshBox box;
  std::ranges::copy(least, box[0].begin());
  std::ranges::copy(most, box[1].begin());
  return box;
}

std::vector<Piece> surroundings_of(const BakedScene& scene) {
  constexpr Transform<double> kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  std::vector<Piece> pieces;
  for (const BakedSurface& surface : scene.surfaces)
    pieces.push_back({static_cast<std::uint32_t>(surface.mesh), surface.object, kIdentity});
  for (const BakedPlants& plants : scene.plants) {
    for (std::size_t k = 0; k < plants.mesh.size(); ++k)
      pieces.push_back({plants.mesh[k], plants.object, upright(plants.transform[k])});
  }
  return pieces;
}

}  // namespace

SceneAccelerator::SceneAccelerator(const BakedScene& scene, RTCFilterFunctionN filter)
    : scene_(scene),
      device_(new_device()),
      meshes_(scene.meshes.size()),
      normals_(scene.meshes.size()),
      mirrors_(scene) {
  for (const BakedMesh& mesh : scene.meshes) boxes_.push_back(box_of(mesh));
  std::vector<bool> is_surface(scene.meshes.size());
  for (const BakedSurface& surface : scene.surfaces) is_surface[surface.mesh] = true;
  // Normals in parallel with trees, because both have a serial part.
  parallel_for(2 * scene.meshes.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t task = begin; task < end; ++task) {
      const std::size_t k = task % scene.meshes.size();
      const BakedMesh& mesh = scene.meshes[k];
      if (task < scene.meshes.size()) {
        meshes_[k] = scene_of(device_.get(), mesh, filter, is_surface[k]);
      } else if (mesh.smooth) {
        normals_[k] = vertex_normals(mesh);
      }
    }
  });
  surroundings_ = set_of(surroundings_of(scene));
  if (!has_water()) return;
  std::map<std::pair<std::uint16_t, std::uint32_t>, bool> wet;  // by object and mesh, which plants share
  for (const Piece& piece : surroundings_.pieces) {
    const auto [known, is_new] = wet.try_emplace({piece.object, piece.mesh}, false);
    if (is_new) {
      known->second =
          std::ranges::any_of(scene_.meshes[piece.mesh].material_index,
                              [&](std::uint16_t material) { return is_water(piece.object, material); });
    }
    if (known->second) waters_.push_back(piece);
  }
}

PieceSet SceneAccelerator::set_of(std::vector<Piece> pieces) const {
  PieceSet set{.pieces = std::move(pieces), .scene = new_scene(device_.get())};
  for (std::size_t k = 0; k < set.pieces.size(); ++k) {
    const Piece& piece = set.pieces[k];
    if (!can_be_entered(piece.to_world)) continue;
    Transform<float> to_world{};
    std::ranges::transform(piece.to_world, to_world.begin(),
                           [](double entry) { return static_cast<float>(entry); });
    const EmbreeGeometry instance(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(instance.get(), meshes_[piece.mesh].get());
    rtcSetGeometryTransform(instance.get(), 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, to_world.data());
    rtcCommitGeometry(instance.get());
    rtcAttachGeometryByID(set.scene.get(), instance.get(), static_cast<unsigned>(k));
  }
  commit(device_.get(), set.scene.get());
  return set;
}

}  // namespace thermal
