#include "io/exr_header.h"

#include "io/exr_spellings.h"

namespace thermal {
namespace {

/// Channel of a pass in a layer, or in the only layer that has it.
const ExrChannel* find_pass(const ExrHeader& header, const std::string& layer, PassKind kind,
                            std::string_view axis = "") {
  std::vector<const ExrChannel*> channels;
  for (const ExrChannel& channel : header.channels) {
    if (layer.empty() || channel.layer == layer) channels.push_back(&channel);
  }
  return only_best_of(channels, kind, axis, "layer");
}

}  // namespace

const ExrChannel* ExrHeader::find_object_index(const std::string& layer) const {
  return find_pass(*this, layer, PassKind::object_index);
}

const ExrChannel* ExrHeader::find_material_index(const std::string& layer) const {
  return find_pass(*this, layer, PassKind::material_index);
}

const ExrChannel* ExrHeader::find_depth(const std::string& layer) const {
  return find_pass(*this, layer, PassKind::depth);
}

const ExrChannel* ExrHeader::find_normal(const std::string& layer, const std::string& component) const {
  return find_pass(*this, layer, PassKind::normal, component);
}

}  // namespace thermal
