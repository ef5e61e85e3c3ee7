#include "raycast/seen_triangles.h"

namespace thermal {

SeenTriangle SeenTriangles::seen(unsigned number_of_piece, unsigned number) const noexcept {
  const Piece& piece = shot_.piece(number_of_piece);
  const BakedMesh& mesh = shot_.accelerator.scene().meshes[piece.mesh];
  const auto& normals = shot_.accelerator.normals(piece.mesh);
  std::array<Vector3, 3> corner_m;
  std::array<Vector3, 3> normal;
  for (std::size_t which = 0; which < 3; ++which) {
    const std::size_t corner = mesh.triangles[number][which];
    corner_m[which] = vector_of(mesh.points_m[corner]);
    if (!normals.empty()) normal[which] = vector_of(normals[corner]);
  }
  const auto& to_world = piece.to_world;
  const Vector3& first = corner_m[0];
  return {.piece = number_of_piece,
          .number = number,
          .object = piece.object,
          .material = mesh.material_index[number],
          .height_m = to_world[8] * first.x + to_world[9] * first.y + to_world[10] * first.z + to_world[11],
          .sight = sight_of(shot_.view, piece.to_world, corner_m, normal)};
}

}  // namespace thermal
