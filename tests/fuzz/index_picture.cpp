#include "io/image/index_picture.h"

#include "fuzz/pass_demands.h"
#include "fuzz/pass_manifests.h"
#include "fuzz/targets.h"

void fuzz::index_picture(Bytes bytes) {
  static const std::vector<thermal::Manifest> kManifests = small_manifests();
  static const std::vector<thermal::PassReader> kReaders = readers_of(kManifests);
  if (bytes.empty()) return;
  const auto file = as_file(bytes, "index.png");
  const std::size_t choice = bytes.back() % kReaders.size();
  tolerate([&] { (void)kReaders[choice].planes_in(file); });
  tolerate([&] { demand_whole(kReaders[choice].read(file, {}), {}, kManifests[choice]); });
}
