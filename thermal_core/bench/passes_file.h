#pragma once

#include "bench/bench_scene.h"
#include "io/system/files.h"

namespace thermal {

/// Writes a frame's planes as Veldt's Blender side does: layer "Scene" with indices, depth and normals, single
/// precision, uncompressed. IoError with the file.
void write_passes(const Path& file, const Passes& passes);

/// The same scene with every pixel repeated `factor` times in both directions, as from a finer camera with the same
/// view.
[[nodiscard]] BenchScene enlarged(const BenchScene& scene, int factor);

}  // namespace thermal
