#include "io/config/config.h"

#include "base/text.h"
#include "fuzz/targets.h"
#include "support/assets.h"

namespace {

const std::string kName = "config.json";

/// A resolved config is valid; a resumed run compares it with the resolved form of the new one.
void resolve_twice(thermal::Json document) {
  const thermal::Json resolved = thermal::resolve_config(std::move(document), kName, kAssets).document;
  demand(thermal::resolve_config(resolved, kName, kAssets).document == resolved,
         "a resolved config is resolved to itself");
}

void apply_settings(std::string_view lines) {
  static const thermal::Json kDemo = thermal::read_json(VELDT_SOURCE_DIR "/configs/demo.json");
  thermal::Json document = kDemo;
  for (const std::string_view line : thermal::split(lines, '\n'))
    thermal::apply_setting(document, std::string(line));
  resolve_twice(std::move(document));
}

}  // namespace

void fuzz::config(Bytes bytes) {
  const std::string_view text = text_of(bytes);
  tolerate([text] {
    if (!text.starts_with('{')) return apply_settings(text);
    thermal::Json document = thermal::parse_json(text, kName);
    thermal::root_files(document, "folder");
    resolve_twice(std::move(document));
  });
}
