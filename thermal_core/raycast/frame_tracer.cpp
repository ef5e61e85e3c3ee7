#include "raycast/frame_tracer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>

#include "base/parallel.h"
#include "raycast/first_hit.h"
#include "raycast/mirrors.h"

namespace thermal {
namespace {

constexpr float kFarthestCameraM = 1e9F;  // from the origin; farther away it sees nothing

/// False for NaN.
bool is_valid(const RayPacket& packet, std::size_t k) noexcept {
  const float place_m =
      std::abs(packet.ray.org_x[k]) + std::abs(packet.ray.org_y[k]) + std::abs(packet.ray.org_z[k]);
  const float size =
      std::abs(packet.ray.dir_x[k]) + std::abs(packet.ray.dir_y[k]) + std::abs(packet.ray.dir_z[k]);
  return place_m < kFarthestCameraM && size < 2;
}

/// Disables a ray. Embree ends the program at NaN and at huge numbers; and its version 3 ignores the mask of packets
/// that are larger than the vectors of the instruction set.
void end_at_once(RayPacket& packet, std::size_t k) noexcept {
  packet.ray.org_x[k] = packet.ray.org_y[k] = packet.ray.org_z[k] = 0;
  packet.ray.dir_x[k] = packet.ray.dir_y[k] = 0;
  packet.ray.dir_z[k] = 1;
  packet.ray.tfar[k] = -1;
}

}  // namespace

Packet block_at(int x_px, int y_px, const PixelRays& rays, const Plane<std::uint8_t>& near_actors) {
  Packet packet;
  const auto width = static_cast<std::size_t>(rays.width_px());
  for (int y = y_px; y < std::min(y_px + kBlockPx, rays.height_px()); ++y) {
    for (int x = x_px; x < std::min(x_px + kBlockPx, rays.width_px()); ++x) {
      const auto column = static_cast<std::size_t>(x);
      const auto row = static_cast<std::size_t>(y);
      packet.add(rays.at(column, row), row * width + column);
      packet.near_actors |= near_actors.at(x, y) != 0;
    }
  }
  return packet;
}

RayPacket aimed(const View& view, const VectorLanes<double>& direction,
                const std::array<double, 2>& depth_range_m) noexcept {
  Lanes<double> nearest_m{};
  nearest_m.fill(depth_range_m[0]);
  return aimed(view, direction, nearest_m, depth_range_m[1]);
}

RayPacket aimed(const View& view, const VectorLanes<double>& direction, const Lanes<double>& nearest_m,
                double farthest_m) noexcept {
  const UnitLanes unit = units(direction);
  const auto x_m = static_cast<float>(view.position_m.x);
  const auto y_m = static_cast<float>(view.position_m.y);
  const auto z_m = static_cast<float>(view.position_m.z);
  RayPacket packet;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const auto start_m = static_cast<float>(nearest_m[k] * unit.length[k]);
    packet.ray.org_x[k] = x_m + start_m * unit.direction[0][k];
    packet.ray.org_y[k] = y_m + start_m * unit.direction[1][k];
    packet.ray.org_z[k] = z_m + start_m * unit.direction[2][k];
    packet.ray.dir_x[k] = unit.direction[0][k];
    packet.ray.dir_y[k] = unit.direction[1][k];
    packet.ray.dir_z[k] = unit.direction[2][k];
    packet.ray.tnear[k] = 0;
    packet.ray.tfar[k] = static_cast<float>((farthest_m - nearest_m[k]) * unit.length[k]);
    packet.ray.time[k] = 0;
    packet.ray.mask[k] = ~0U;
    packet.ray.id[k] = static_cast<unsigned>(k);
    packet.ray.flags[k] = 0;
    packet.hit.geomID[k] = kNothing;
    packet.hit.instID[0][k] = kNothing;
    if (!is_valid(packet, k)) end_at_once(packet, k);
  }
  return packet;
}

namespace {

const SeenTriangle kSky;

/// Destinations of hits, by pixel or sample; null: not needed.
struct SightSink {
  std::uint16_t* object_index = nullptr;
  std::uint16_t* material_index = nullptr;
  float* depth_m = nullptr;
  std::array<float*, 3> normal{};
};

/// Destinations of mirrored hits. Few frames show water that mirrors more than sky, so memory is allocated when the
/// first one is found.
class MirrorSink {
 public:
  /// `make_room` allocates the planes and fills them with sky; it is called at most once.
  MirrorSink(bool wanted, std::function<SightSink()> make_room)
      : wanted_(wanted), make_room_(std::move(make_room)) {}

  [[nodiscard]] bool is_wanted() const noexcept { return wanted_; }
  [[nodiscard]] const SightSink& room() {
    std::call_once(made_, [this] { sink_ = make_room_(); });
    return sink_;
  }
  /// Whether `make_room` was called; valid after tracing.
  [[nodiscard]] bool has_room() const noexcept { return sink_.object_index != nullptr; }

 private:
  bool wanted_;
  std::function<SightSink()> make_room_;
  std::once_flag made_;
  SightSink sink_;
};

/// Destinations of all results.
struct Sink {
  SightSink seen;
  MirrorSink& mirrored;
  std::uint16_t* actor_index = nullptr;
};

template <typename T>
T* pixels_of(Plane<T>& plane, bool wanted, const PixelRays& rays) {
  plane.resize(wanted ? rays.width_px() : 0, wanted ? rays.height_px() : 0);
  return wanted ? plane.pixels().data() : nullptr;
}

template <typename T>
T* samples_of(std::vector<T>& list, bool wanted, std::size_t samples) {
  list.resize(wanted ? samples : 0);
  return wanted ? list.data() : nullptr;
}

/// Planes or lists as destinations; `destination_in` allocates one if it is needed.
template <typename Sights, typename DestinationIn>
SightSink sink_for(Sights& out, bool indices, bool depth, bool normals, const DestinationIn& destination_in) {
  return {.object_index = destination_in(out.object_index, indices),
          .material_index = destination_in(out.material_index, indices),
          .depth_m = destination_in(out.depth_m, depth),
          .normal = {destination_in(out.normal[0], normals), destination_in(out.normal[1], normals),
                     destination_in(out.normal[2], normals)}};
}

/// One thread's caches of a shot's triangles.
struct TriangleCaches {
  explicit TriangleCaches(const Shot& shot) : seen(shot), mirrors(shot) {}

  SeenTriangles seen;
  Mirrors mirrors;
};

class RayTracer {
 public:
  RayTracer(const Shot& shot, const Sink& sink) : shot_(shot), sink_(sink) {}

  /// Actors first, for the actor layer; their hits then bound the search among the surroundings.
  void trace(const Packet& rays, TriangleCaches& caches) const {
    const VectorLanes<double> direction = directions(shot_.view, rays.x, rays.y);
    RayPacket packet = aimed(shot_.view, direction, shot_.accelerator.scene().depth_range_m);
    FirstHitSearch first(direction, caches.seen);
    if (rays.near_actors) first.search(shot_.actors, 0, rays.mask, packet);
    if (sink_.actor_index != nullptr) put_actors(first.hits(), rays);
    first.search(shot_.accelerator.surroundings(), shot_.first_surrounding(), rays.mask, packet);
    put_sights(direction, first.hits(), rays, caches.seen, sink_.seen);
    if (sink_.mirrored.is_wanted()) trace_mirrored(direction, first.hits(), rays, caches);
  }

 private:
  void put_actors(const FirstHits& hits, const Packet& rays) const noexcept {
    for (std::size_t k = 0; k < rays.rays; ++k) {
      const unsigned piece = hits.piece[k];
      sink_.actor_index[rays.places[k]] = piece == kNoPiece ? std::uint16_t{0} : shot_.piece(piece).object;
    }
  }

  /// Rays of one packet nearly always hit one water.
  void trace_mirrored(const VectorLanes<double>& direction, const FirstHits& hits, const Packet& rays,
                      TriangleCaches& caches) const {
    std::array<bool, kLanes> wet{};
    Lanes<double> height_m{};
    for (std::size_t k = 0; k < rays.rays; ++k) {
      const std::size_t target = rays.places[k];
      if (!shot_.accelerator.is_water(sink_.seen.object_index[target], sink_.seen.material_index[target]))
        continue;
      if (hits.piece[k] == kNoPiece || !(direction[2][k] < 0)) continue;
      wet[k] = true;
      height_m[k] = caches.seen.at(hits.piece[k], hits.triangle[k]).height_m;
    }
    for (std::size_t first = 0; first < rays.rays; ++first) {
      if (!wet[first]) continue;
      Packet on_water;
      for (std::size_t k = first; k < rays.rays; ++k) {
        if (!wet[k] || height_m[k] != height_m[first]) continue;
        on_water.add({.x = rays.x[k], .y = rays.y[k]}, rays.places[k]);
        wet[k] = false;
      }
      trace_up(on_water, caches.mirrors.at(height_m[first]));
    }
  }

  /// Traces rays from the water upwards.
  void trace_up(const Packet& rays, Mirror& mirror) const {
    const Shot& shot = mirror.shot();
    const VectorLanes<double> direction = directions(shot.view, rays.x, rays.y);
    RayPacket packet =
        aimed(shot.view, direction, mirror.depths_m(direction), shot.accelerator.scene().depth_range_m[1]);
    FirstHitSearch first(direction, mirror.triangles());
    first.search(shot.actors, 0, rays.mask, packet);
    first.search(shot.accelerator.surroundings(), shot.first_surrounding(), rays.mask, packet);
    const auto is_sky = [](unsigned piece) { return piece == kNoPiece; };
    if (std::ranges::all_of(first.hits().piece, is_sky)) return;
    put_sights(direction, first.hits(), rays, mirror.triangles(), sink_.mirrored.room());
  }

  static void put_sights(const VectorLanes<double>& direction, const FirstHits& hits, const Packet& rays,
                         SeenTriangles& triangles, const SightSink& sink) noexcept {
    TriangleLanes lanes;  // NOLINT(cppcoreguidelines-pro-type-member-init): all lanes are filled in
    for (std::size_t k = 0; k < kLanes; ++k) {
      const bool sky = hits.piece[k] == kNoPiece;
      const SeenTriangle& triangle = sky ? kSky : triangles.at(hits.piece[k], hits.triangle[k]);
      put_lane(triangle.sight, k, lanes);
      if (k >= rays.rays) continue;
      sink.object_index[rays.places[k]] = triangle.object;
      sink.material_index[rays.places[k]] = triangle.material;
    }
    if (sink.depth_m == nullptr && sink.normal[0] == nullptr) return;
    SightLanes sights;  // NOLINT(cppcoreguidelines-pro-type-member-init): likewise
    see_triangles(direction, lanes, sights);
    for (std::size_t k = 0; k < rays.rays; ++k) {
      const bool sky = hits.piece[k] == kNoPiece;
      const std::size_t target = rays.places[k];
      if (sink.depth_m != nullptr) sink.depth_m[target] = sky ? kSkyDepthM : sights.depth_m[k];
      for (std::size_t axis = 0; sink.normal[0] != nullptr && axis < 3; ++axis)
        sink.normal[axis][target] = sky ? 0.0F : sights.normal[axis][k];
    }
  }

  const Shot& shot_;
  const Sink& sink_;
};

/// The samples of one row of pixels, pixel by pixel.
void trace_row(const RayTracer& tracer, const PixelRays& rays, const Plane<std::uint8_t>& near_actors,
               int row, const FineSamples& fine, TriangleCaches& caches) {
  Packet packet;
  const auto side = static_cast<std::size_t>(fine.factor);
  const std::size_t begin = fine.row_begin[static_cast<std::size_t>(row)];
  for (std::size_t pixel = 0; pixel < fine.pixels_in(row); ++pixel) {
    const std::size_t x_px = fine.x_px[begin + pixel];
    for (std::size_t k = 0; k < side * side; ++k) {
      const std::size_t line = k / side;
      const std::size_t target = fine.line_begin(row, static_cast<int>(line)) + pixel * side + k % side;
      packet.add(rays.at(x_px * side + k % side, static_cast<std::size_t>(row) * side + line), target);
      packet.near_actors |= near_actors.at(static_cast<int>(x_px), row) != 0;
      if (!packet.is_full()) continue;
      tracer.trace(packet, caches);
      packet = {};
    }
  }
  if (packet.rays > 0) tracer.trace(packet, caches);
}

}  // namespace

void trace_pixels(const Shot& shot, const PixelRays& rays, const Plane<std::uint8_t>& near_actors,
                  const PassNeeds& needs, Passes& out) {
  const bool mirrored = needs.mirrored && shot.accelerator.has_water();
  const auto pixels = [&](auto& plane, bool wanted) { return pixels_of(plane, wanted, rays); };
  MirrorSink mirrors(mirrored, [&] {
    set_to_sky(out.mirrored, rays.width_px(), rays.height_px());
    return sink_for(out.mirrored, true, true, true, pixels);
  });
  const Sink sink = {.seen = sink_for(out, true, needs.depth, needs.normals, pixels),
                     .mirrored = mirrors,
                     .actor_index = pixels(out.actor_index, needs.actors)};
  out.ranks.clear();
  const RayTracer tracer(shot, sink);
  const auto rows = static_cast<std::size_t>((rays.height_px() + kBlockPx - 1) / kBlockPx);
  parallel_for(rows, 2, [&](std::size_t begin, std::size_t end) {
    TriangleCaches caches(shot);
    for (int y_px = static_cast<int>(begin) * kBlockPx; y_px < static_cast<int>(end) * kBlockPx;
         y_px += kBlockPx) {
      for (int x_px = 0; x_px < rays.width_px(); x_px += kBlockPx)
        tracer.trace(block_at(x_px, y_px, rays, near_actors), caches);
    }
  });
  if (!mirrors.has_room()) out.mirrored = {};
}

void trace_samples(const Shot& shot, const PixelRays& rays, const Plane<std::uint8_t>& near_actors,
                   const PassNeeds& needs, FineSamples& fine) {
  const auto side = static_cast<std::size_t>(fine.factor);
  const std::size_t samples = side * side * fine.x_px.size();
  const bool mirrored = needs.mirrored && shot.accelerator.has_water();
  const auto list = [&](auto& values, bool wanted) { return samples_of(values, wanted, samples); };
  MirrorSink mirrors(mirrored, [&] {
    set_to_sky(fine.mirrored, samples);
    return sink_for(fine.mirrored, true, true, true, list);
  });
  const Sink sink = {.seen = sink_for(fine, true, needs.depth, needs.normals, list),
                     .mirrored = mirrors,
                     .actor_index = list(fine.actor_index, needs.actors)};
  const RayTracer tracer(shot, sink);
  parallel_for(static_cast<std::size_t>(near_actors.height_px()), 8, [&](std::size_t begin, std::size_t end) {
    TriangleCaches caches(shot);
    for (auto row = static_cast<int>(begin); row < static_cast<int>(end); ++row)
      trace_row(tracer, rays, near_actors, row, fine, caches);
  });
  if (!mirrors.has_room()) fine.mirrored = {};
}

}  // namespace thermal
