#pragma once

#include "bench/bench_scene.h"
#include "io/files.h"

namespace thermal {

/// Writes a frame's planes as our Blender side does: layer "Scene" with indices, depth and normals, single precision,
/// not compressed. IoError naming the file.
void write_passes(const Path& file, const Passes& passes);

/// The same scene with every pixel `factor` times as wide and as high, as a finer camera of the same view has it.
[[nodiscard]] BenchScene enlarged(const BenchScene& scene, int factor);

}  // namespace thermal
