#include "fuzz/targets.h"
#include "io/manifest_file.h"
#include "io/pass_reader.h"
#include "support/assets.h"

void fuzz::manifest(Bytes bytes) {
  const auto file = as_file(bytes, "manifest.json");
  tolerate([&file] {
    const thermal::Manifest manifest = thermal::read_manifest(file, kAssets);
    manifest.validate();
    const thermal::PassReader reader(manifest);
  });
}
