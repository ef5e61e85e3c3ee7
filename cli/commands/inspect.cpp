#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "dataset/inspect/inspection.h"
#include "dataset/inspect/starter_manifest.h"
#include "io/assets.h"

namespace veldt {
namespace {

using thermal::Inspection;

constexpr std::size_t kMostLines = 40;
constexpr std::size_t kMostNames = 4;

/// Prints lines up to a limit and counts the rest; --json has all.
void print_lines(const std::vector<std::string>& lines) {
  for (std::size_t i = 0; i < std::min(lines.size(), kMostLines); ++i) print("  {}\n", lines[i]);
  if (lines.size() > kMostLines) print("  … and {} more; --json lists them\n", lines.size() - kMostLines);
}

void print_block(const std::string& heading, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  print("{}\n", heading);
  print_lines(lines);
}

std::string of_frames(const Inspection& inspection) {
  return inspection.survey.frames > 1 ? fmt::format(", of {} frames", inspection.survey.frames) : "";
}

void print_files(const Inspection& inspection) {
  const thermal::FrameSequence& sequence = inspection.sequence;
  const auto gaps = static_cast<std::size_t>(sequence.gaps());
  const std::size_t files = sequence.frames.size() - gaps;
  const std::string& compression = inspection.header.compression;
  print("{}\n  {} x {} px{}{}\n", inspection.file.string(), inspection.header.width_px,
        inspection.header.height_px, compression.empty() ? "" : ", compression " + compression,
        files > 1 ? fmt::format("; the first of {} files", files) : "");
  if (const auto& window = inspection.window)
    print("  pixels only in {} x {} px from ({}, {})\n", window->width_px, window->height_px, window->x_px,
          window->y_px);
  std::vector<std::string> missing;
  for (const auto& [name, is_gap] : sequence.frames)
    if (is_gap) missing.push_back(name.name);
  if (gaps > 0) print("  missing: {}\n", thermal::list_names(missing, kMostNames));
  if (inspection.manifest && inspection.manifest->overscan_px > 0)
    print("  overscan: {} camera px on every side\n", inspection.manifest->overscan_px);
  if (inspection.manifest && !inspection.manifest->lens.is_none())
    print("  rays follow the lens: {}\n", name_of(inspection.manifest->lens));
}

/// The use of a channel in a conversion; empty if it is not used.
std::string use_of(const Inspection& inspection, const thermal::ExrChannel& channel) {
  const std::string name = channel.full_name();
  const thermal::ChosenPlanes& planes = inspection.planes;
  if (name == planes.objects) return "object index";
  if (name == planes.materials) return "material index";
  if (name == planes.depth) return "depth";
  if (name == planes.normals) return "normal";
  const bool is_matte = !inspection.cryptomatte.empty() && name.starts_with(inspection.cryptomatte);
  return is_matte ? "cryptomatte" : "";
}

/// A pass of one layer, with its components.
struct PassLine {
  std::string layer;
  std::string pass;
  std::string type;
  std::string components;
  std::string use;
};

std::vector<PassLine> passes_of(const Inspection& inspection) {
  std::vector<PassLine> lines;
  for (const thermal::ExrChannel& channel : inspection.header.channels) {
    const std::string use = use_of(inspection, channel);
    const auto same = std::find_if(lines.begin(), lines.end(), [&channel](const PassLine& line) {
      return std::tie(line.layer, line.pass, line.type) ==
             std::tie(channel.layer, channel.pass, channel.type);
    });
    if (same == lines.end()) {
      lines.push_back({channel.layer, channel.pass, channel.type, channel.component, use});
    } else {
      same->components += " " + channel.component;
      if (same->use.empty()) same->use = use;
    }
  }
  return lines;
}

void print_layers(const Inspection& inspection) {
  std::vector<std::pair<std::string, std::vector<std::string>>> layers;  // in the file's order
  for (const PassLine& line : passes_of(inspection)) {
    auto layer = std::find_if(layers.begin(), layers.end(),
                              [&line](const auto& one) { return one.first == line.layer; });
    if (layer == layers.end()) layer = layers.insert(layers.end(), {line.layer, {}});
    std::string text = fmt::format("{:<24} {:<10} {:<6} {}", line.pass, line.components, line.type, line.use);
    text.erase(text.find_last_not_of(' ') + 1);
    layer->second.push_back(std::move(text));
  }
  for (const auto& [name, lines] : layers) print_block(name.empty() ? "no layer" : "layer " + name, lines);
}

void print_indices(const Inspection& inspection) {
  std::vector<std::string> objects;
  for (const auto& [index, pixels] : inspection.survey.objects) {
    const std::string name = object_name(inspection, index);
    objects.push_back(fmt::format("{:>5} {:>9} px{}{}", index, pixels, name.empty() ? "" : "  ", name));
  }
  print_block("object indices" + of_frames(inspection), objects);
  std::vector<std::string> materials;
  for (const auto& [index, pixels] : inspection.survey.materials)
    materials.push_back(fmt::format("{:>5} {:>9} px", index, pixels));
  print_block("material indices" + of_frames(inspection), materials);
}

void print_colours(const Inspection& inspection) {
  std::vector<std::pair<std::int64_t, thermal::Colour>> by_pixels;
  for (const auto& [colour, pixels] : inspection.survey.colours) by_pixels.emplace_back(-pixels, colour);
  std::sort(by_pixels.begin(), by_pixels.end());
  std::vector<std::string> lines;
  for (const auto& [less, colour] : by_pixels)
    lines.push_back(fmt::format("[{}] {:>9} px", fmt::join(colour, ", "), -less));
  print_block("colours" + of_frames(inspection), lines);
}

void print_cryptomattes(const Inspection& inspection) {
  for (const auto& [name, mattes] : inspection.survey.cryptomattes) {
    std::vector<std::tuple<std::int64_t, std::string>> by_pixels;
    for (const auto& [hash, matte] : mattes) {
      const std::string text = hash == 0 ? "(nothing)" : fmt::format("({:08x}, no name in the file)", hash);
      by_pixels.emplace_back(-matte.pixels, matte.name.empty() ? text : matte.name);
    }
    std::sort(by_pixels.begin(), by_pixels.end());
    std::vector<std::string> lines;
    for (const auto& [less, matte] : by_pixels) lines.push_back(fmt::format("{:>9} px  {}", -less, matte));
    print_block(fmt::format("cryptomatte {}{}", name, of_frames(inspection)), lines);
  }
  print_block("cryptomatte faults", inspection.cryptomatte_faults);
}

std::string or_none(const std::string& channel, const std::string& none) {
  return channel.empty() ? none : channel;
}

/// Quoted for a shell where needed.
std::string typed(const thermal::Path& path) {
  const std::string text = path.string();
  const bool plain = text.find_first_of(" \t'\"\\$`*?#%&()[]{};<>|!~") == std::string::npos;
  return plain ? text : fmt::format("\"{}\"", text);
}

void print_meanings(const Inspection& inspection) {
  if (inspection.manifest) {
    print("  meanings   the manifest's\n");
    return;
  }
  const thermal::Path& folder = inspection.group.folder;
  print("  meanings   unknown: no manifest.json; to start one\n");
  print("             veldt inspect {} --starter-manifest {}\n", typed(folder),
        typed(folder / "manifest.json"));
}

std::string objects_from(const Inspection& inspection) {
  if (!inspection.cryptomatte.empty()) return "cryptomatte " + inspection.cryptomatte;
  return or_none(inspection.planes.objects, "the picture");
}

void print_conversion(const Inspection& inspection) {
  print("conversion\n");
  if (!inspection.obstacle.empty()) {
    print("  cannot be converted: {}\n", inspection.obstacle);
    if (!inspection.layers.empty())
      print("  --layer {} inspects that one\n", typed(inspection.layers.front()));
    for (const std::string& channel : inspection.likely)
      print("  {} holds whole numbers: \"channels\": {{\"object_index\": \"{}\"}} selects it\n", channel,
            channel);
    return;
  }
  print("  objects    {}\n", objects_from(inspection));
  print("  materials  {}\n", or_none(inspection.planes.materials, "those of the objects"));
  print("  depth      {}\n", or_none(inspection.planes.depth, "none"));
  print("  normals    {}\n", or_none(inspection.planes.normals, "none"));
  print_meanings(inspection);
}

void print_bad_frames(const Inspection& inspection) {
  std::vector<std::string> lines;
  for (const auto& [file, reason] : inspection.survey.bad_frames) lines.push_back(file + ": " + reason);
  if (inspection.survey.frames > 0) print_block("bad frames", lines);
}

/// Prints the contents of passes, and how a conversion would use them.
void print_inspection(const Inspection& inspection) {
  print_files(inspection);
  print_layers(inspection);
  print_indices(inspection);
  print_colours(inspection);
  print_cryptomattes(inspection);
  if (const auto& depth = inspection.survey.depth)
    print("depth{}\n  {:.2f} m to {:.2f} m\n", of_frames(inspection), depth->nearest_m, depth->farthest_m);
  print_bad_frames(inspection);
  print_conversion(inspection);
}

/// Prints a starter manifest's guesses, the entries that the user has to fill in, and the next command.
void print_starter(const thermal::StarterManifest& starter, const Inspection& inspection,
                   const thermal::Path& file) {
  print("\n{}: starter manifest\n", file.string());
  print_block("guessed; check these", starter.guesses);
  print_block("to fill in", starter.to_fill_in);
  const thermal::Path& folder = inspection.group.folder;
  const bool beside = (folder / "manifest.json").lexically_normal() == file.lexically_normal();
  print("then\n  veldt convert {}{} --out dataset\n", typed(folder),
        beside ? "" : fmt::format(" --manifest {}", typed(file)));
}

using thermal::Inspection;
using thermal::Path;

struct InspectArguments {
  std::vector<std::string> passes;
  std::string manifest;
  std::string layer;
  std::string starter;
  double max_megapixels = 256;
  bool all_frames = false;
  bool json = false;
};

thermal::InspectOptions request_of(const InspectArguments& options) {
  return {.assets = thermal::Assets::find(),
          .passes = {options.passes.begin(), options.passes.end()},
          .manifest = options.manifest,
          .layer = options.layer,
          .all_frames = options.all_frames || !options.starter.empty(),
          .for_starter = !options.starter.empty(),
          .limits = read_limits(options.max_megapixels)};
}

/// Called before any frame is read, because reading all of them may take a while.
void check_starter(const Path& file) {
  if (file.empty()) return;
  const auto refuse = [&file](const char* rule) {
    throw thermal::ConfigError(thermal::fault("--starter-manifest", file.string(), "", rule));
  };
  if (std::filesystem::exists(file)) refuse("a file that does not exist yet");
  if (file.has_parent_path() && !std::filesystem::is_directory(file.parent_path()))
    refuse("a file in an existing folder");
}

Inspection inspect(const InspectArguments& options, const CommonOptions& common) {
  watch_for_stop();
  ProgressBar bar(common);
  return thermal::inspect(request_of(options), hooks_for(bar));
}

void write_starter(const Inspection& inspection, const InspectArguments& options) {
  const thermal::StarterManifest starter =
      thermal::starter_manifest(inspection, thermal::NameGuesser(thermal::Assets::find()));
  thermal::write_file_atomically(options.starter, thermal::to_text(starter.document));
  if (!options.json) print_starter(starter, inspection, options.starter);
}

int run_inspect(const InspectArguments& options, const CommonOptions& common) {
  check_starter(options.starter);
  const Inspection inspection = inspect(options, common);
  options.json ? print_json(to_json(inspection)) : print_inspection(inspection);
  if (!options.starter.empty()) write_starter(inspection, options);
  return kDone;
}

}  // namespace

void add_inspect(Parser& parser) {
  Command command =
      parser.add_command("inspect", "What is in these passes, and what convert would do with them");
  command.footer("Example: veldt inspect passes --starter-manifest passes/manifest.json");
  auto options = std::make_shared<InspectArguments>();
  command
      .add_option("passes", options->passes,
                  "A folder of passes; or files, or a quoted pattern such as \"r/f_####.exr\", of one folder")
      .required();
  const Option manifest =
      command.add_option("--manifest", options->manifest, "Manifest to use instead of the folder's")
          .type_name("FILE");
  command.add_option("--layer", options->layer, "Layer of an EXR file that has several").type_name("NAME");
  command.add_flag("--all-frames", options->all_frames, "Inspect every frame, not only the first");
  command
      .add_option("--starter-manifest", options->starter,
                  "Inspect every frame and write a manifest to fill in; never overwrites a file")
      .type_name("FILE")
      .excludes(manifest);
  add_max_megapixels(command, options->max_megapixels);
  command.add_flag("--json", options->json, "Print JSON");
  command.runs([options](const CommonOptions& common) { return run_inspect(*options, common); });
}

}  // namespace veldt
