#include "io/exr/passes.h"

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "io/exr/file.h"
#include "io/exr/indices.h"
#include "io/exr/planes.h"

namespace thermal {
namespace {

using IndexPlanes = std::array<std::optional<ExrIndexPlane>, 3>;  // of objects, materials and actors

IndexPlanes index_planes(const ExrPlanes& planes, const PassNeeds& needs, PassBuffer& out) {
  IndexPlanes indices;
  indices[0].emplace(planes.objects(), out.pixels[0]);
  if (const ExrChannel* materials = planes.materials()) indices[1].emplace(*materials, out.pixels[1]);
  const ExrChannel* actors = needs.actors ? planes.actors() : nullptr;
  if (actors != nullptr) indices[2].emplace(*actors, out.pixels[2]);
  return indices;
}

void take(const std::optional<ExrIndexPlane>& plane, Plane<std::uint16_t>& out) {
  if (plane) {
    plane->indices(out);
  } else {
    out = {};
  }
}

void read(ExrFile& opened, const ExrLayout& layout, const PassNeeds& needs, PassBuffer& out) {
  check_size(opened.header(), layout);
  const ExrPlanes planes(opened.header(), layout);
  IndexPlanes indices = index_planes(planes, needs, out);
  std::vector<ExrTarget> targets;
  for (std::optional<ExrIndexPlane>& plane : indices) {
    if (plane) targets.push_back(plane->target());
  }
  Passes& passes = out.passes;
  for (const ExrTarget& target : shape_targets(planes, needs, passes)) targets.push_back(target);
  opened.decode(targets);
  take(indices[0], passes.object_index);
  take(indices[1], passes.material_index);
  take(indices[2], passes.actor_index);
  passes.ranks.clear();
}

}  // namespace

Passes read_passes(const Path& file, const ExrLayout& layout, const PassNeeds& needs) {
  PassBuffer buffer;
  read_passes(file, layout, needs, buffer);
  return std::move(buffer.passes);
}

void read_passes(const Path& file, const ExrLayout& layout, const PassNeeds& needs, PassBuffer& out) {
  with_exr_file(file, layout.limits, [&](ExrFile& opened) { read(opened, layout, needs, out); });
}

PassNeeds planes_in_exr(const Path& file, const ExrLayout& layout) {
  return with_exr_file(file, layout.limits, [&](const ExrFile& opened) {
    const ExrPlanes planes(opened.header(), layout);
    PassNeeds there = planes_beside(planes);
    there.actors = planes.actors() != nullptr;
    return there;
  });
}

}  // namespace thermal
