#include "io/exr/planes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/exr/passes_writer.h"
#include "io/exr/pixels.h"

namespace thermal {
namespace {

constexpr std::array<std::string_view, 3> kAxes = {"X", "Y", "Z"};

std::string quoted(const std::string& text) { return fmt::format("\"{}\"", text); }

/// Blender's File Output node and others write an index as a picture, with the same numbers in each colour.
std::string how_to_name_a_picture(const ExrHeader& header) {
  const auto pictures = pictures_in(header);
  if (pictures.empty()) return "";
  return fmt::format(
      "; an index that was written as a picture is named by \"channels\": {{\"object_index\": \"{}\"}} in "
      "the manifest",
      pictures.front().front()->full_name());
}

std::string names_of(const ExrHeader& header) { return list_names(full_names(header.channels)); }

std::string wrong_layer(const std::string& key, const std::string& name,
                        const std::vector<std::string>& layers) {
  return fault(key, quoted(name), "", "a layer with an object index: " + list_names(layers)) +
         did_you_mean(name, layers);
}

/// The channel that a manifest's `key` names; among several of that name, the layer's.
const ExrChannel& named(const ExrHeader& header, const std::string& layer, const std::string& key,
                        const std::string& name) {
  std::vector<const ExrChannel*> found;
  for (const ExrChannel& channel : header.channels) {
    if (channel.full_name() == name) return channel;
    if (channel.name == name) found.push_back(&channel);
  }
  const std::vector<std::string> all = full_names(header.channels);
  if (found.empty())
    throw DataError(fault(key, quoted(name), "", "a channel of the file: " + list_names(all)) +
                    did_you_mean(name, all));
  if (found.size() == 1) return *found.front();
  std::vector<std::string> candidates;
  for (const ExrChannel* channel : found) {
    if (!layer.empty() && channel->layer == layer) return *channel;
    candidates.push_back(channel->full_name());
  }
  throw DataError(
      fault(key, quoted(name), "", "one of the channels of that name: " + list_names(candidates)));
}

/// A pass of several components: the prefix of their .X, .Y and .Z.
std::string pass_of(const std::string& channel) { return channel.substr(0, channel.rfind('.')); }

std::vector<std::string> passes_in(const ExrHeader& header) {
  std::vector<std::string> passes;
  for (const ExrChannel& channel : header.channels) {
    std::string pass = pass_of(channel.full_name());
    const bool known = std::find(passes.begin(), passes.end(), pass) != passes.end();
    if (!channel.component.empty() && !known) passes.push_back(std::move(pass));
  }
  return passes;
}

/// A component of the pass that a manifest names as normals; among several of that name, the layer's.
const ExrChannel& named_normal(const ExrHeader& header, const std::string& layer, const std::string& pass,
                               std::string_view axis) {
  std::vector<const ExrChannel*> found;
  for (const ExrChannel& channel : header.channels) {
    const bool same_name = pass_of(channel.name) == pass && channel.layer == layer;
    if (!channel.component.empty() && (pass_of(channel.full_name()) == pass || same_name))
      found.push_back(&channel);
  }
  if (const ExrChannel* channel = axis_of(found, axis)) return *channel;
  const std::vector<std::string> passes = passes_in(header);
  const bool known = std::find(passes.begin(), passes.end(), pass) != passes.end();
  throw DataError(fault("channels.normal", quoted(pass), "",
                        fmt::format("a pass with a channel .{} in the file: {}", axis, list_names(passes))) +
                  (known ? "" : did_you_mean(pass, passes)));
}

}  // namespace

ExrPlanes::ExrPlanes(const ExrHeader& header, const ExrLayout& layout) : header_(header), layout_(layout) {
  const std::string& name = layout.channels.object_index;
  if (!name.empty()) named_objects_ = &named(header, layout.layer, "channels.object_index", name);
  objects_ = named_objects_ != nullptr ? named_objects_ : &find_objects();
  layer_ = layout.layer.empty() ? objects_->layer : layout.layer;
}

bool ExrPlanes::is_object_index(const ExrChannel& channel) const {
  if (named_objects_ == nullptr) return pass_kind_of(channel.pass) == PassKind::object_index;
  return channel.pass == named_objects_->pass && channel.component == named_objects_->component;
}

std::vector<const ExrChannel*> ExrPlanes::indices_in(const std::optional<std::string>& layer) const {
  std::vector<const ExrChannel*> found;
  for (const ExrChannel& channel : header_.channels) {
    if (is_object_index(channel) && (!layer || channel.layer == *layer)) found.push_back(&channel);
  }
  return found;
}

std::vector<std::string> ExrPlanes::index_layers() const {
  std::vector<std::string> layers;
  for (const ExrChannel* channel : indices_in(std::nullopt)) {
    if (std::find(layers.begin(), layers.end(), channel->layer) == layers.end())
      layers.push_back(channel->layer);
  }
  return layers;
}

/// The object index of everything: without a named layer, the one that is not the actors'.
const ExrChannel& ExrPlanes::find_objects() const {
  std::optional<std::string> layer;
  if (!layout_.layer.empty()) layer = layout_.layer;
  if (!layer && !(layout_.actor_layer.empty() && layout_.mirror_layer.empty())) {
    std::vector<std::string> layers = index_layers();
    std::erase_if(layers, [this](const std::string& one) {
      return !one.empty() && (one == layout_.actor_layer || one == layout_.mirror_layer);
    });
    if (layers.size() == 1) layer = layers.front();
  }
  const ExrChannel* found = only_best_of(indices_in(layer), PassKind::object_index, "", "layer");
  if (found != nullptr) return *found;
  const std::vector<std::string> layers = index_layers();
  if (layers.empty())
    throw DataError(
        fmt::format("no object index channel; expected one such as Scene.IndexOB.X; the file has: {}{}",
                    names_of(header_), how_to_name_a_picture(header_)));
  throw DataError(wrong_layer("layer", layout_.layer, layers));
}

const ExrChannel* ExrPlanes::find_beside(PassKind kind, std::string_view axis) const {
  std::vector<std::string> others = index_layers();
  if (!layout_.actor_layer.empty()) others.push_back(layout_.actor_layer);
  if (!layout_.mirror_layer.empty()) others.push_back(layout_.mirror_layer);
  std::vector<const ExrChannel*> here;
  std::vector<const ExrChannel*> elsewhere;
  for (const ExrChannel& channel : header_.channels) {
    const bool loose = has_bare_name(channel) || has_bare_name(*objects_);
    if (channel.layer == layer_) {
      here.push_back(&channel);
    } else if (loose && std::find(others.begin(), others.end(), channel.layer) == others.end()) {
      elsewhere.push_back(&channel);
    }
  }
  const ExrChannel* found = best_of(here, kind, axis);
  return found != nullptr ? found : only_best_of(elsewhere, kind, axis, "channels");
}

const ExrChannel* ExrPlanes::materials() const {
  const std::string& name = layout_.channels.material_index;
  return name.empty() ? find_beside(PassKind::material_index)
                      : &named(header_, layer_, "channels.material_index", name);
}

const ExrChannel* ExrPlanes::depth() const {
  const std::string& name = layout_.channels.depth;
  return name.empty() ? find_beside(PassKind::depth) : &named(header_, layer_, "channels.depth", name);
}

const ExrChannel* ExrPlanes::normal(std::string_view axis) const {
  const std::string& name = layout_.channels.normal;
  return name.empty() ? find_beside(PassKind::normal, axis) : &named_normal(header_, layer_, name, axis);
}

const ExrChannel* ExrPlanes::actors() const {
  if (layout_.actor_layer.empty()) return nullptr;
  const std::vector<const ExrChannel*> found = indices_in(layout_.actor_layer);
  if (!found.empty())
    return named_objects_ != nullptr ? found.front() : best_of(found, PassKind::object_index);
  std::vector<std::string> layers = index_layers();
  std::erase(layers, objects_->layer);
  if (!layout_.mirror_layer.empty()) std::erase(layers, layout_.mirror_layer);
  if (layers.empty()) return nullptr;
  throw DataError(wrong_layer("actor_layer", layout_.actor_layer, layers));
}

const ExrChannel* ExrPlanes::sampled() const {
  const auto found = std::ranges::find_if(header_.channels, [this](const ExrChannel& channel) {
    return channel.layer == layer_ && channel.pass == kSampledPass;
  });
  return found == header_.channels.end() ? nullptr : &*found;
}

const ExrChannel& ExrPlanes::required(const ExrChannel* channel, const std::string& plane) const {
  if (channel != nullptr) return *channel;
  throw DataError(
      fmt::format("no {} channel, which the chosen terms need; the file has: {}", plane, names_of(header_)));
}

const ExrChannel& ExrPlanes::required_depth() const { return required(depth(), "depth"); }

const ExrChannel& ExrPlanes::required_normal(std::string_view axis) const {
  return required(normal(axis), fmt::format("normal {}", axis));
}

void check_size(const ExrHeader& header, const ExrLayout& layout) {
  if (layout.width_px == 0) return;
  if (header.width_px == layout.width_px && header.height_px == layout.height_px) return;
  throw DataError(fault("size", fmt::format("{} x {}", header.width_px, header.height_px), "px",
                        fmt::format("the manifest's {} x {} px", layout.width_px, layout.height_px)));
}

void check_projection(const ExrHeader& header, const ExrLayout& layout) {
  constexpr double kTolerance = 0.01;
  if (!header.environment.empty())
    throw DataError(fault("envmap", header.environment, "", "none: the picture of a pinhole camera"));
  if (header.pixel_aspect == 1 || layout.pixel_aspect == 0) return;
  if (std::abs(header.pixel_aspect / layout.pixel_aspect - 1) <= kTolerance) return;
  throw DataError(
      fault("pixelAspectRatio", fmt::format("{:.6g}", header.pixel_aspect), "",
            fmt::format("{:.6g}, the manifest's camera.fy_px / camera.fx_px", layout.pixel_aspect)));
}

std::vector<ExrTarget> shape_targets(const ExrPlanes& planes, const PassNeeds& needs, Plane<float>& depth_m,
                                     std::array<Plane<float>, 3>& normal) {
  std::vector<ExrTarget> targets;
  const ExrChannel* const depth = needs.depth            ? &planes.required_depth()
                                  : needs.depth_if_there ? planes.depth()
                                                         : nullptr;
  if (depth != nullptr) {
    targets.push_back({.channel = depth, .plane = &depth_m, .outside = kSkyDepthM});
  } else {
    depth_m = {};
  }
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    if (needs.normals) {
      targets.push_back(
          {.channel = &planes.required_normal(kAxes[axis]), .plane = &normal[axis], .outside = 0});
    } else {
      normal[axis] = {};
    }
  }
  return targets;
}

PassNeeds planes_beside(const ExrPlanes& planes) {
  const bool normals = std::all_of(kAxes.begin(), kAxes.end(),
                                   [&](std::string_view axis) { return planes.normal(axis) != nullptr; });
  return {.depth = planes.depth() != nullptr, .normals = normals, .actors = false};
}

}  // namespace thermal
