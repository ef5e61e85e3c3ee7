#pragma once

#include <array>
#include <vector>

#include "scene/baked_scene.h"

namespace thermal {

/// Unit normals of a mesh's points: the mean of the normals of the triangles around, weighted by their angles there, as
/// Blender has them. A point with degenerate triangles or none has its direction from the origin. Source: G. Thürrner
/// and C. A. Wüthrich, Computing vertex normals from polygonal facets, J. Graphics Tools 3(1).
[[nodiscard]] std::vector<std::array<float, 3>> vertex_normals(const BakedMesh& mesh);

}  // namespace thermal
