#include "analysis/balance/selection.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "base/rng.h"

namespace thermal {
namespace {

constexpr std::uint32_t kSelectionStream = 0x53454C45;  // apart from the sensor's

SelectedVideo select_of(const BalanceVideo& video, const std::vector<std::int64_t>& taken,
                        std::uint32_t seed) {
  SelectedVideo selected{.name = video.name, .frames = {}};
  for (std::size_t j = 0; j < video.types.size(); ++j) {
    const std::vector<int> frames = choose_frames(video.types[j].frames, taken[j], seed, video.name);
    selected.frames.insert(selected.frames.end(), frames.begin(), frames.end());
  }
  std::sort(selected.frames.begin(), selected.frames.end());
  return selected;
}

std::vector<SelectedClass> classes_of(const BalanceProgram& program, const BalanceSolution& solution) {
  std::vector<SelectedClass> classes;
  for (std::size_t k = 0; k < kBalanceClasses; ++k) {
    SelectedClass one{.name = balance_class_names()[k],
                      .at_least = program.bounds[k].at_least,
                      .at_most = program.bounds[k].at_most};
    for (std::size_t i = 0; i < program.videos.size(); ++i) {
      one.available += program.videos[i].available()[k];
      one.taken += solution.labels_of(program, i)[k];
    }
    classes.push_back(one);
  }
  return classes;
}

}  // namespace

std::vector<BalanceVideo> videos_of(const std::vector<LabelSource>& sources) {
  std::vector<BalanceVideo> all;
  for (const LabelSource& source : sources) {
    for (BalanceVideo& video : frame_types(source.labels)) all.push_back(std::move(video));
  }
  return all;
}

std::vector<int> choose_frames(const std::vector<int>& frames, std::int64_t count, std::uint32_t seed,
                               const std::string& video) {
  assert(count >= 0 && static_cast<std::size_t>(count) <= frames.size());
  const std::uint64_t name = hash_name(video);
  std::vector<std::pair<std::uint64_t, int>> drawn;
  for (const int frame : frames) {
    const auto words =
        Philox4x32::generate({0, static_cast<std::uint32_t>(frame), static_cast<std::uint32_t>(name),
                              static_cast<std::uint32_t>(name >> 32)},
                             {seed, kSelectionStream});
    drawn.emplace_back(std::uint64_t{words[1]} << 32 | words[0], frame);
  }
  std::sort(drawn.begin(), drawn.end());
  std::vector<int> chosen;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) chosen.push_back(drawn[i].second);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

Selection select_frames(const std::vector<LabelSource>& sources, const BalanceProgram& program,
                        const BalanceResult& result, std::uint32_t seed) {
  Selection selection{.seed = seed,
                      .classes = classes_of(program, result.solution),
                      .objective = result.solution.objective,
                      .bound = result.bound,
                      .gap = result.gap,
                      .datasets = {}};
  std::size_t i = 0;
  for (const LabelSource& source : sources) {
    SelectedDataset dataset{.path = source.path, .name = source.labels.name, .videos = {}};
    for (std::size_t video = 0; video < source.labels.videos.size(); ++video, ++i)
      dataset.videos.push_back(select_of(program.videos[i], result.solution.taken[i], seed));
    selection.datasets.push_back(std::move(dataset));
  }
  return selection;
}

}  // namespace thermal
