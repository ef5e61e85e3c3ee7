#include "io/exr_passes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/exr_scan.h"
#include "scene/manifest.h"

namespace thermal {
namespace {

using PassNames = std::array<std::string_view, 2>;

/// Spellings in use, Blender's first.
constexpr PassNames kObjectIndex = {"IndexOB", "Object Index"};
constexpr PassNames kMaterialIndex = {"IndexMA", "Material Index"};
constexpr PassNames kDepth = {"Depth", "Z"};
constexpr PassNames kNormal = {"Normal", "N"};

std::string type_name(Imf::PixelType type) {
  if (type == Imf::HALF) return "half";
  return type == Imf::UINT ? "uint" : "float";
}

std::string compression_name(Imf::Compression compression) {
  static const std::array<const char*, 10> kNames = {"none",  "RLE", "ZIPS", "ZIP",  "PIZ",
                                                     "PXR24", "B44", "B44A", "DWAA", "DWAB"};
  const auto number = static_cast<std::size_t>(compression);
  return number < kNames.size() ? kNames.at(number) : "unknown";
}

/// Takes "layer.pass.component" apart; a component is one letter.
ExrChannel take_apart(const std::string& name, int part, Imf::PixelType type) {
  ExrChannel channel = {
      .part = part, .name = name, .layer = "", .pass = name, .component = "", .type = type_name(type)};
  const std::size_t last = channel.pass.rfind('.');
  if (last != std::string::npos && last + 2 == channel.pass.size()) {
    channel.component = channel.pass.substr(last + 1);
    channel.pass.erase(last);
  }
  const std::size_t dot = channel.pass.rfind('.');
  if (dot != std::string::npos) {
    channel.layer = channel.pass.substr(0, dot);
    channel.pass.erase(0, dot + 1);
  }
  return channel;
}

/// `component` empty: the first there is.
const ExrChannel* find_pass(const ExrHeader& header, const PassNames& names, const std::string& layer,
                            const std::string& component = "") {
  std::vector<const ExrChannel*> found;
  for (const ExrChannel& channel : header.channels) {
    const bool named = std::find(names.begin(), names.end(), channel.pass) != names.end();
    const bool wanted = component.empty() || channel.component == component;
    if (named && wanted && (layer.empty() || channel.layer == layer)) found.push_back(&channel);
  }
  if (found.empty()) return nullptr;
  std::set<std::string> layers;
  for (const ExrChannel* channel : found) layers.insert(channel->layer);
  if (layers.size() == 1) return found.front();
  const std::vector<std::string> list(layers.begin(), layers.end());
  throw DataError(fmt::format("{} is in several layers: {}; expected the manifest's \"layer\" to name one",
                              found.front()->pass, list_names(list)));
}

/// Runs `read` on the opened file, turning the library's faults into ours.
template <typename Read>
auto with_file(const Path& file, const Read& read) {
  if (!std::filesystem::exists(file))
    throw IoError(fmt::format("cannot read {}: there is no such file", file.string()));
  const auto unreadable = [&file](const std::exception& error) {
    return IoError(fmt::format("cannot read {}: {}", file.string(), error.what()));
  };
  try {
    check_exr_headers(file);
  } catch (const DataError& error) {
    throw unreadable(error);
  }
  try {
    Imf::MultiPartInputFile opened(file.c_str(), 1);
    return read(opened);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw unreadable(error);
  }
}

ExrHeader header_of(const Imf::MultiPartInputFile& opened) {
  ExrHeader header;
  const Imf::Header& first = opened.header(0);
  const Imath::Box2i& window = first.dataWindow();
  header.width_px = window.max.x - window.min.x + 1;
  header.height_px = window.max.y - window.min.y + 1;
  header.compression = compression_name(first.compression());
  if (first.displayWindow() != window) {
    throw DataError("the data window is not the display window; expected the whole picture");
  }
  for (int part = 0; part < opened.parts(); ++part) {
    const Imf::ChannelList& channels = opened.header(part).channels();
    if (opened.header(part).dataWindow() != window) {
      throw DataError(fmt::format("part {} has another size than part 0; expected all alike", part));
    }
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
      header.channels.push_back(take_apart(channel.name(), part, channel.channel().type));
    }
  }
  return header;
}

/// Reads channels into planes of float, decoding each part of the file once.
std::vector<Plane<float>> read_channels(Imf::MultiPartInputFile& opened, const ExrHeader& header,
                                        const std::vector<const ExrChannel*>& channels) {
  std::vector<Plane<float>> planes(channels.size());
  for (int part_number = 0; part_number < opened.parts(); ++part_number) {
    const Imath::Box2i window = opened.header(part_number).dataWindow();
    Imf::FrameBuffer buffer;
    for (std::size_t i = 0; i < channels.size(); ++i) {
      if (channels[i]->part != part_number) continue;
      planes[i] = Plane<float>(header.width_px, header.height_px);
      float* const pixels = planes[i].pixels().data();
      buffer.insert(channels[i]->name, Imf::Slice::Make(Imf::FLOAT, pixels, window, sizeof(float)));
    }
    if (buffer.begin() == buffer.end()) continue;
    Imf::InputPart part(opened, part_number);
    part.setFrameBuffer(buffer);
    part.readPixels(window.min.y, window.max.y);
  }
  return planes;
}

/// A plane of indices; the first that is none is named.
Plane<std::uint16_t> to_indices(const Plane<float>& plane, const std::string& channel) {
  Plane<std::uint16_t> indices(plane.width_px(), plane.height_px());
  const auto in = plane.pixels();
  const auto out = indices.pixels();
  bool all_good = true;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const float value = in[i];
    const bool inside = value >= 0 && value <= static_cast<float>(kLargestIndex);  // false for NaN
    const int index = inside ? static_cast<int>(value) : 0;
    all_good &= inside && static_cast<float>(index) == value;
    out[i] = static_cast<std::uint16_t>(index);
  }
  if (all_good) return indices;
  const auto is_index = [](float value) {
    return value >= 0 && value <= static_cast<float>(kLargestIndex) && value == std::floor(value);
  };
  const auto bad = std::find_if_not(in.begin(), in.end(), is_index);
  const auto at = static_cast<int>(bad - in.begin());
  throw DataError(
      fault(fmt::format("{} at pixel ({}, {})", channel, at % plane.width_px(), at / plane.width_px()),
            fmt::format("{}", *bad), "", fmt::format("a whole number from 0 to {}", kLargestIndex)));
}

void check_size(const ExrHeader& header, int width_px, int height_px) {
  if (width_px == 0 || (header.width_px == width_px && header.height_px == height_px)) return;
  throw DataError(fault("size", fmt::format("{} x {}", header.width_px, header.height_px), "px",
                        fmt::format("the manifest's {} x {} px", width_px, height_px)));
}

/// What an EXR file has, for faults about what it has not.
std::string names_of(const ExrHeader& header) {
  std::vector<std::string> names;
  for (const ExrChannel& channel : header.channels) names.push_back(channel.name);
  return list_names(names);
}

const ExrChannel& require_object_index(const ExrHeader& header, const std::string& layer) {
  if (const ExrChannel* channel = header.find_object_index(layer)) return *channel;
  throw DataError(
      fmt::format("no object index channel{}; expected one like Scene.IndexOB.X, the file has: {}",
                  layer.empty() ? "" : " in layer " + layer, names_of(header)));
}

const ExrChannel* require(const ExrChannel* channel, std::string_view what, const ExrHeader& header) {
  if (channel != nullptr) return channel;
  throw DataError(
      fmt::format("no {} channel, which the chosen terms need; the file has: {}", what, names_of(header)));
}

/// Adds the file's name to faults found inside it.
template <typename Work>
auto naming(const Path& file, const Work& work) {
  try {
    return work();
  } catch (const DataError& error) {
    throw DataError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace

const ExrChannel* ExrHeader::find_object_index(const std::string& layer) const {
  return find_pass(*this, kObjectIndex, layer);
}

const ExrChannel* ExrHeader::find_material_index(const std::string& layer) const {
  return find_pass(*this, kMaterialIndex, layer);
}

const ExrChannel* ExrHeader::find_depth(const std::string& layer) const {
  return find_pass(*this, kDepth, layer);
}

const ExrChannel* ExrHeader::find_normal(const std::string& layer, const std::string& component) const {
  return find_pass(*this, kNormal, layer, component);
}

ExrHeader read_exr_header(const Path& file) {
  return naming(file, [&] { return with_file(file, header_of); });
}

Plane<float> read_exr_channel(const Path& file, const ExrHeader& header, const ExrChannel& channel) {
  return with_file(file, [&](Imf::MultiPartInputFile& opened) {
    return std::move(read_channels(opened, header, {&channel}).front());
  });
}

namespace {

/// Channels of the planes that are needed: objects, then whichever of the others there are to be.
struct ChosenChannels {
  std::vector<const ExrChannel*> channels;
  bool materials = false;
  bool actors = false;
};

/// Layers in which there is an object index, in the file's order.
std::vector<std::string> index_layers(const ExrHeader& header) {
  std::vector<std::string> layers;
  for (const ExrChannel& channel : header.channels) {
    const bool is_index =
        std::find(kObjectIndex.begin(), kObjectIndex.end(), channel.pass) != kObjectIndex.end();
    if (is_index && std::find(layers.begin(), layers.end(), channel.layer) == layers.end())
      layers.push_back(channel.layer);
  }
  return layers;
}

/// The layer of everything: where none is named, the one beside that of actors.
std::string main_layer(const ExrHeader& header, const std::string& layer, const std::string& actor_layer) {
  if (!layer.empty() || actor_layer.empty()) return layer;
  std::vector<std::string> layers = index_layers(header);
  std::erase(layers, actor_layer);
  return layers.size() == 1 ? layers.front() : layer;
}

/// Null for a frame without that layer. That a frame has another one instead is taken for a slip of the pen.
const ExrChannel* find_actors(const ExrHeader& header, const ExrChannel& objects,
                              const std::string& actor_layer) {
  std::vector<std::string> layers = index_layers(header);
  if (std::find(layers.begin(), layers.end(), actor_layer) != layers.end())
    return header.find_object_index(actor_layer);
  std::erase(layers, objects.layer);
  if (layers.empty()) return nullptr;
  throw DataError(fault("actor_layer", fmt::format("\"{}\"", actor_layer), "",
                        "a layer with an object index: " + list_names(layers)) +
                  did_you_mean(actor_layer, layers));
}

ChosenChannels choose_channels(const ExrHeader& header, const std::string& layer, const PassNeeds& needs,
                               const std::string& actor_layer) {
  const ExrChannel& objects = require_object_index(header, main_layer(header, layer, actor_layer));
  ChosenChannels chosen{.channels = {&objects}, .materials = false, .actors = false};
  if (const ExrChannel* materials = header.find_material_index(objects.layer)) {
    chosen.channels.push_back(materials);
    chosen.materials = true;
  }
  const ExrChannel* actors = needs.actors ? find_actors(header, objects, actor_layer) : nullptr;
  if (actors != nullptr) {
    chosen.channels.push_back(actors);
    chosen.actors = true;
  }
  if (needs.depth) chosen.channels.push_back(require(header.find_depth(objects.layer), "depth", header));
  if (!needs.normals) return chosen;
  for (const char* component : {"X", "Y", "Z"}) {
    const ExrChannel* channel = header.find_normal(objects.layer, component);
    chosen.channels.push_back(require(channel, fmt::format("normal {}", component), header));
  }
  return chosen;
}

}  // namespace

Passes read_passes(const Path& file, const std::string& layer, int width_px, int height_px,
                   const PassNeeds& needs, const std::string& actor_layer) {
  return naming(file, [&] {
    return with_file(file, [&](Imf::MultiPartInputFile& opened) {
      const ExrHeader header = header_of(opened);
      check_size(header, width_px, height_px);
      const ChosenChannels chosen = choose_channels(header, layer, needs, actor_layer);
      std::vector<Plane<float>> planes = read_channels(opened, header, chosen.channels);
      Passes passes;
      auto plane = planes.begin();
      auto channel = chosen.channels.begin();
      passes.object_index = to_indices(*plane++, (*channel++)->name);
      if (chosen.materials) passes.material_index = to_indices(*plane++, (*channel++)->name);
      if (chosen.actors) passes.actor_index = to_indices(*plane++, (*channel++)->name);
      if (needs.depth) passes.depth_m = std::move(*plane++);
      for (Plane<float>& normal : passes.normal) {
        if (needs.normals) normal = std::move(*plane++);
      }
      return passes;
    });
  });
}

}  // namespace thermal
