#include "io/config/variants.h"

#include "fuzz/targets.h"
#include "io/config/config.h"
#include "support/assets.h"

namespace {

const thermal::Json& demo() {
  static const thermal::Json kDemo = thermal::read_json(VELDT_SOURCE_DIR "/configs/demo.json");
  return kDemo;
}

}  // namespace

void fuzz::variants(Bytes bytes) {
  tolerate([bytes] {
    const thermal::Json document = thermal::parse_json(text_of(bytes), "variants.json");
    for (const thermal::Variant& variant : thermal::read_variants(document, "variants.json", kAssets))
      (void)thermal::resolve_config(thermal::changed_by(variant, demo()), variant.where, kAssets);
  });
}
