#include "io/exr/passes.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "io/exr/file.h"
#include "io/exr/pixels.h"
#include "io/exr/planes.h"
#include "scene/passes.h"

namespace thermal {
namespace {

using IndexPlanes = std::array<std::optional<ExrIndexPlane>, 6>;  // as in PassBuffer

/// Layout of the planes of mirrored surfaces.
ExrLayout mirror_of(const ExrLayout& layout) {
  return {.layer = layout.mirror_layer, .width_px = layout.width_px, .height_px = layout.height_px};
}

/// Whether to read mirrored surfaces. Frames without water lack the layer.
bool has_mirror(const ExrHeader& header, const ExrLayout& layout, const PassNeeds& needs) {
  return needs.mirrored && !layout.mirror_layer.empty() &&
         std::ranges::any_of(header.channels,
                             [&](const ExrChannel& channel) { return channel.layer == layout.mirror_layer; });
}

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
  check_projection(opened.header(), layout);
  const ExrPlanes planes(opened.header(), layout);
  const ExrLayout mirror_layout = mirror_of(layout);
  std::optional<ExrPlanes> mirror;
  if (has_mirror(opened.header(), layout, needs)) mirror.emplace(opened.header(), mirror_layout);
  IndexPlanes indices = index_planes(planes, needs, out);
  if (mirror) {
    indices[3].emplace(mirror->objects(), out.pixels[3]);
    if (const ExrChannel* materials = mirror->materials()) indices[4].emplace(*materials, out.pixels[4]);
  }
  std::vector<ExrTarget> targets;
  for (std::optional<ExrIndexPlane>& plane : indices) {
    if (plane) targets.push_back(plane->target());
  }
  const ExrChannel* const sampled = layout.supersample > 1 ? planes.sampled() : nullptr;
  if (sampled != nullptr) targets.push_back(indices[5].emplace(*sampled, out.pixels[5]).target());
  Passes& passes = out.passes;
  for (const ExrTarget& target : shape_targets(planes, needs, passes.depth_m, passes.normal))
    targets.push_back(target);
  if (mirror) {
    const PassNeeds all = {.depth = true, .normals = true};
    for (const ExrTarget& target :
         shape_targets(*mirror, all, passes.mirrored.depth_m, passes.mirrored.normal))
      targets.push_back(target);
  } else {
    passes.mirrored = {};
  }
  opened.decode(targets);
  take(indices[0], passes.object_index);
  take(indices[1], passes.material_index);
  take(indices[2], passes.actor_index);
  take(indices[3], passes.mirrored.object_index);
  take(indices[4], passes.mirrored.material_index);
  passes.ranks.clear();
  passes.fine = {};
  if (!indices[5]) return;
  Plane<std::uint16_t> places;
  indices[5]->indices(places);
  passes = separated(passes, places, layout.supersample);
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
    there.mirrored = !layout.mirror_layer.empty();
    return there;
  });
}

}  // namespace thermal
