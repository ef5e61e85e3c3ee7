// Runs a target over existing inputs: seeds, and inputs that once revealed a fault. Any compiler, any sanitizer.
//
// fuzz_replay TARGET FILE|FOLDER…: 0 if everything passed, 1 with the file's name if one took too long or could not
// be opened, 2 for an unknown target; an exception or a sanitizer's report ends it as it ends the target.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iterator>
#include <map>
#include <vector>

#include "fuzz/targets.h"

namespace {

using Path = std::filesystem::path;

constexpr double kLongestS = 5;  // of processor time, whatever else the machine does

const std::map<std::string_view, void (*)(Bytes)> kTargets = {
    {"baked_scene", fuzz::baked_scene}, {"birdsai", fuzz::birdsai},
    {"calibration", fuzz::calibration}, {"coco", fuzz::coco},
    {"config", fuzz::config},           {"dataset", fuzz::dataset},
    {"detections", fuzz::detections},   {"exr_passes", fuzz::exr_passes},
    {"ground_maps", fuzz::ground_maps}, {"index_picture", fuzz::index_picture},
    {"manifest", fuzz::manifest},       {"picture", fuzz::picture},
    {"scene_plan", fuzz::scene_plan},   {"tracks", fuzz::tracks},
    {"variants", fuzz::variants}};

/// Files of these folders, and these files, in an order that is the same everywhere. A folder may be missing.
std::vector<Path> inputs_of(int count, char** paths) {
  std::vector<Path> inputs;
  for (const Path path : std::vector<std::string>(paths, paths + count)) {
    if (std::filesystem::is_regular_file(path)) inputs.push_back(path);
    if (!std::filesystem::is_directory(path)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(path)) inputs.push_back(entry.path());
  }
  std::ranges::sort(inputs);
  return inputs;
}

std::vector<std::uint8_t> content_of(const Path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool runs_in_time(void (*target)(Bytes), const Path& input) {
  const std::vector<std::uint8_t> bytes = content_of(input);
  const std::clock_t start = std::clock();
  target(bytes);
  const bool in_time = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC <= kLongestS;
  if (!in_time) std::fprintf(stderr, "%s took more than 5 s\n", input.c_str());
  return in_time;
}

}  // namespace

/// Like -malloc_limit_mb of libFuzzer: no reader may allocate half a gigabyte at once for an input of a few kB.
extern "C" const char* __asan_default_options() { return "max_allocation_size_mb=512"; }

int main(int count, char** arguments) {
  const auto target = kTargets.find(count < 2 ? "" : arguments[1]);
  if (target == kTargets.end()) {
    std::fputs("usage: fuzz_replay TARGET FILE|FOLDER...; targets:", stderr);
    for (const auto& [name, function] : kTargets) std::fprintf(stderr, " %s", name.data());
    std::fputs("\n", stderr);
    return 2;
  }
  const std::vector<Path> inputs = inputs_of(count - 2, arguments + 2);
  std::size_t good = 0;
  for (const Path& input : inputs) {
    std::printf("%s\n", input.c_str());  // the last one printed is the one that ended it
    std::fflush(stdout);
    if (runs_in_time(target->second, input)) ++good;
  }
  std::printf("%zu of %zu inputs are sound\n", good, inputs.size());
  return inputs.empty() || good < inputs.size() ? 1 : 0;
}
