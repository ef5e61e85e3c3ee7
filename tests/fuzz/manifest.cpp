#include "fuzz/targets.h"
#include "io/manifest_file.h"
#include "io/pass_reader.h"

void fuzz::manifest(Bytes bytes) {
  const auto file = as_file(bytes, "manifest.json");
  tolerate([&file] {
    const thermal::Manifest manifest = thermal::read_manifest(file, VELDT_SOURCE_DIR);
    manifest.validate();
    const thermal::PassReader reader(manifest);
  });
}
