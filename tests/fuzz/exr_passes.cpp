#include "fuzz/pass_demands.h"
#include "fuzz/pass_manifests.h"
#include "fuzz/targets.h"
#include "io/exr/cryptomatte.h"
#include "io/exr/passes.h"

void fuzz::exr_passes(Bytes bytes) {
  static const std::vector<thermal::Manifest> kManifests = small_manifests();
  static const std::vector<thermal::PassReader> kReaders = readers_of(kManifests);
  if (bytes.empty()) return;
  const auto file = as_file(bytes, "passes.exr");
  const unsigned last = bytes.back();
  const std::size_t choice = last % kReaders.size();
  const thermal::PassNeeds needs = {.depth = (last & 64U) == 0, .normals = (last & 32U) == 0, .actors = true};
  tolerate([&] { (void)thermal::cryptomattes_in(thermal::read_exr_header(file)); });
  tolerate([&] { (void)kReaders[choice].planes_in(file); });
  tolerate([&] { demand_whole(kReaders[choice].read(file, needs), needs, kManifests[choice]); });
}
