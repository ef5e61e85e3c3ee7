#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/command.h"
#include "io/exr_passes.h"
#include "io/manifest_file.h"
#include "io/resources.h"
#include "labels/instances.h"

namespace veldt {
namespace {

using thermal::Json;
using thermal::Path;

/// The EXR files a path means: itself, or those of a folder in order.
std::vector<Path> files_of(const Path& what) {
  if (!std::filesystem::is_directory(what)) return {what};
  std::vector<Path> files;
  for (const auto& entry : std::filesystem::directory_iterator(what)) {
    if (entry.path().extension() == ".exr") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) throw thermal::IoError(fmt::format("{} holds no .exr file", what.string()));
  return files;
}

std::optional<thermal::Manifest> manifest_beside(const Path& file) {
  const Path manifest = file.parent_path() / "manifest.json";
  if (!std::filesystem::exists(manifest)) return std::nullopt;
  return thermal::read_manifest(manifest, thermal::find_home());
}

std::string object_name(const std::optional<thermal::Manifest>& manifest, int index) {
  if (index == thermal::kSkyIndex) return "sky";
  if (!manifest) return "";
  for (const thermal::ManifestObject& object : manifest->objects) {
    if (object.index == index) return object.name;
  }
  return "not in the manifest";
}

Json describe_channels(const thermal::ExrHeader& header) {
  Json channels = Json::array();
  for (const thermal::ExrChannel& channel : header.channels) {
    channels.push_back({{"name", channel.name}, {"part", channel.part}, {"type", channel.type}});
  }
  return channels;
}

Json describe_indices(const Path& file, const std::string& layer,
                      const std::optional<thermal::Manifest>& manifest) {
  const thermal::Passes passes = thermal::read_passes(file, layer, 0, 0);
  Json indices = Json::array();
  for (const thermal::IndexUse& use : thermal::survey_indices(passes.object_index)) {
    indices.push_back(
        {{"index", use.index}, {"pixels", use.pixels}, {"name", object_name(manifest, use.index)}});
  }
  return indices;
}

/// Nearest and farthest finite depth below the value renderers write for the sky.
Json describe_depth(const Path& file, const thermal::ExrHeader& header, const std::string& layer) {
  const thermal::ExrChannel* channel = header.find_depth(layer);
  if (channel == nullptr) return nullptr;
  constexpr float kSkyFrom = 1e9F;
  float nearest = std::numeric_limits<float>::infinity();
  float farthest = 0;
  const thermal::Plane<float> depth = thermal::read_exr_channel(file, header, *channel);
  for (const float value : depth.pixels()) {
    if (!(value < kSkyFrom)) continue;
    nearest = std::min(nearest, value);
    farthest = std::max(farthest, value);
  }
  if (farthest == 0) return nullptr;
  return {{"nearest_m", nearest}, {"farthest_m", farthest}};
}

std::string verdict(const thermal::ExrHeader& header, const std::string& layer, bool manifest) {
  const thermal::ExrChannel* objects = header.find_object_index(layer);
  if (objects == nullptr) return "cannot be converted: no object index channel, such as Scene.IndexOB.X";
  const thermal::ExrChannel* materials = header.find_material_index(objects->layer);
  return fmt::format(
      "objects from {}, {}, {}", objects->name,
      materials == nullptr ? "materials from the objects" : "materials from " + materials->name,
      manifest ? "meanings from manifest.json" : "needs a manifest (--manifest FILE)");
}

/// Object indices and verdict; what stands against a conversion is a part of the answer, not a failure of it.
std::pair<Json, std::string> describe_conversion(const Path& file, const thermal::ExrHeader& header,
                                                 const std::string& layer,
                                                 const std::optional<thermal::Manifest>& manifest) {
  try {
    const bool has_objects = header.find_object_index(layer) != nullptr;
    Json objects = has_objects ? describe_indices(file, layer, manifest) : Json::array();
    return {std::move(objects), verdict(header, layer, manifest.has_value())};
  } catch (const thermal::DataError& error) {
    std::string why = error.what();
    if (why.starts_with(file.string() + ": ")) why.erase(0, file.string().size() + 2);
    return {Json::array(), "cannot be converted: " + why};
  }
}

Json describe(const Path& file, std::size_t files) {
  const thermal::ExrHeader header = thermal::read_exr_header(file);
  const std::optional<thermal::Manifest> manifest = manifest_beside(file);
  const std::string layer = manifest ? manifest->layer : "";
  const auto [objects, conversion] = describe_conversion(file, header, layer, manifest);
  Json report = {{"file", file.string()},
                 {"files", files},
                 {"width_px", header.width_px},
                 {"height_px", header.height_px},
                 {"compression", header.compression},
                 {"channels", describe_channels(header)},
                 {"objects", objects},
                 {"depth", describe_depth(file, header, layer)},
                 {"conversion", conversion}};
  if (manifest && manifest->overscan_px > 0) report["overscan_px"] = manifest->overscan_px;
  return report;
}

void print(const Json& report) {
  fmt::print("{}\n  {} x {} px, compression {}", report["file"].get<std::string>(),
             report["width_px"].get<int>(), report["height_px"].get<int>(),
             report["compression"].get<std::string>());
  if (report["files"] > 1) fmt::print("; the first of {} files", report["files"].get<std::size_t>());
  if (report.contains("overscan_px")) {
    fmt::print("\n  {} of the camera's px on every side are overscan", report["overscan_px"].get<int>());
  }
  fmt::print("\nchannels\n");
  for (const Json& channel : report["channels"]) {
    fmt::print("  {:<28} {}\n", channel["name"].get<std::string>(), channel["type"].get<std::string>());
  }
  if (!report["objects"].empty()) fmt::print("object indices\n");
  for (const Json& object : report["objects"]) {
    fmt::print("  {:>5} {:>9} px  {}\n", object["index"].get<int>(), object["pixels"].get<unsigned>(),
               object["name"].get<std::string>());
  }
  if (!report["depth"].is_null()) {
    fmt::print("depth\n  {:.2f} m to {:.2f} m\n", report["depth"]["nearest_m"].get<double>(),
               report["depth"]["farthest_m"].get<double>());
  }
  fmt::print("conversion\n  {}\n", report["conversion"].get<std::string>());
}

}  // namespace

void add_inspect(CLI::App& app, Session& session) {
  CLI::App* command =
      add_command(app, session, "inspect", "What is in these passes, and what convert would do with them");
  struct Options {
    std::string what;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  command->add_option("what", options->what, "An EXR file, or a folder of them")->required();
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([options, &session] {
    session.run = [options] {
      const std::vector<Path> files = files_of(options->what);
      const Json report = describe(files.front(), files.size());
      options->json ? fmt::print("{}\n", report.dump(2)) : print(report);
      return static_cast<int>(kDone);
    };
  });
}

}  // namespace veldt
