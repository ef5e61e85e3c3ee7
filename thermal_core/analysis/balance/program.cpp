#include "analysis/balance/program.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {
namespace {

bool is_counted(const LabelSet& set, const Label& label) {
  return !label.ignore && !label.crowd && kind_of(set.categories[label.category].name) != Kind::vehicle;
}

std::size_t class_of(const LabelSet& set, const Label& label) {
  const bool human = kind_of(set.categories[label.category].name) == Kind::human;
  return static_cast<std::size_t>(label.size) + (human ? 3 : 0);
}

/// Number of labels of each class in each image.
std::vector<ClassCounts> count_labels(const LabelSet& set) {
  std::vector<ClassCounts> counts(set.images.size());
  for (const Label& label : set.labels) {
    if (is_counted(set, label)) ++counts[label.image][class_of(set, label)];
  }
  return counts;
}

}  // namespace

const std::array<std::string, kBalanceClasses>& balance_class_names() {
  static const std::array<std::string, kBalanceClasses> kNames = {
      "small_animal", "medium_animal", "large_animal", "small_poacher", "medium_poacher", "large_poacher"};
  return kNames;
}

ClassCounts BalanceVideo::available() const noexcept {
  ClassCounts sums{};
  for (const FrameType& type : types) {
    for (std::size_t k = 0; k < kBalanceClasses; ++k)
      sums[k] += type.labels[k] * static_cast<std::int64_t>(type.frames.size());
  }
  return sums;
}

std::vector<BalanceVideo> frame_types(const LabelSet& set) {
  std::vector<std::map<ClassCounts, std::vector<int>>> found(set.videos.size());
  const std::vector<ClassCounts> counts = count_labels(set);
  for (std::size_t i = 0; i < set.images.size(); ++i)
    found[set.images[i].video][counts[i]].push_back(set.images[i].frame_index);
  std::vector<BalanceVideo> videos;
  for (std::size_t i = 0; i < set.videos.size(); ++i) {
    BalanceVideo video{.name = set.videos[i].name, .types = {}, .unlabelled = 0};
    for (auto& [labels, frames] : found[i]) {
      std::sort(frames.begin(), frames.end());
      if (labels == ClassCounts{})
        video.unlabelled = frames.size();
      else
        video.types.push_back({labels, std::move(frames)});
    }
    videos.push_back(std::move(video));
  }
  return videos;
}

ClassCounts BalanceSolution::labels_of(const BalanceProgram& program, std::size_t video) const {
  ClassCounts labels{};
  const std::vector<FrameType>& types = program.videos[video].types;
  for (std::size_t j = 0; j < types.size(); ++j) {
    for (std::size_t k = 0; k < kBalanceClasses; ++k) labels[k] += types[j].labels[k] * taken[video][j];
  }
  return labels;
}

void BalanceOptions::validate() const {
  if (!(gap >= 0 && gap <= 1))
    throw ConfigError(fault("gap", fmt::format("{}", gap), "", "a number from 0 to 1"));
  if (!(time_limit_s > 0))
    throw ConfigError(fault("time_limit_s", fmt::format("{}", time_limit_s), "s", "a time above 0 s"));
}

BalanceSolution complete_solution(const BalanceProgram& program,
                                  std::vector<std::vector<std::int64_t>> taken) {
  BalanceSolution solution;
  solution.taken = std::move(taken);
  solution.used_up.resize(program.videos.size());
  std::array<bool, kBalanceClasses> some_have_more{};
  ClassCounts top{};
  for (std::size_t i = 0; i < program.videos.size(); ++i) {
    const ClassCounts there = program.videos[i].available();
    const ClassCounts labels = solution.labels_of(program, i);
    for (std::size_t k = 0; k < kBalanceClasses; ++k) {
      top[k] = std::max(top[k], there[k]);
      solution.most[k] = std::max(solution.most[k], labels[k]);
      solution.used_up[i][k] = labels[k] == there[k];
      if (solution.used_up[i][k]) continue;
      solution.least[k] = some_have_more[k] ? std::min(solution.least[k], labels[k]) : labels[k];
      some_have_more[k] = true;
    }
  }
  for (std::size_t k = 0; k < kBalanceClasses; ++k) {
    if (!some_have_more[k]) solution.least[k] = top[k];
    solution.objective += solution.most[k] - solution.least[k];
  }
  return solution;
}

namespace {

/// Whether there is an x for every type and a w for every video.
bool has_shape(const BalanceProgram& program, const BalanceSolution& solution) {
  const std::size_t count = program.videos.size();
  if (solution.taken.size() != count || solution.used_up.size() != count) return false;
  for (std::size_t i = 0; i < count; ++i) {
    if (solution.taken[i].size() != program.videos[i].types.size()) return false;
  }
  return true;
}

class Checker {
 public:
  Checker(const BalanceProgram& program, const BalanceSolution& solution)
      : program_(program), solution_(solution) {}

  std::vector<std::string> check() && {
    for (std::size_t i = 0; i < program_.videos.size(); ++i) check_frames(i);
    for (std::size_t k = 0; k < kBalanceClasses; ++k) check_class(k);
    std::int64_t objective = 0;
    for (std::size_t k = 0; k < kBalanceClasses; ++k) objective += solution_.most[k] - solution_.least[k];
    if (objective != solution_.objective)
      add("objective = {}; expected {}, the sum of u - v", solution_.objective, objective);
    return std::move(faults_);
  }

 private:
  void check_frames(std::size_t i) {
    const BalanceVideo& video = program_.videos[i];
    for (std::size_t j = 0; j < video.types.size(); ++j) {
      const std::int64_t x = solution_.taken[i][j];
      const auto most = static_cast<std::int64_t>(video.types[j].frames.size());
      if (x < 0 || x > most) add("{}: x of type {} = {} frames; expected 0 to {}", video.name, j, x, most);
    }
  }

  void check_class(std::size_t k) {
    std::int64_t top = 0;
    for (std::size_t i = 0; i < program_.videos.size(); ++i) top = std::max(top, available(i, k));
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < program_.videos.size(); ++i) {
      check_video(i, k, top);
      sum += taken(i, k);
    }
    const ClassBounds& bounds = program_.bounds[k];
    if (sum < bounds.at_least || sum > bounds.at_most)
      add("{} = {} labels; expected {} to {}", balance_class_names()[k], sum, bounds.at_least,
          bounds.at_most);
  }

  void check_video(std::size_t i, std::size_t k, std::int64_t top) {
    const std::string& name = program_.videos[i].name;
    const std::string& of = balance_class_names()[k];
    const std::int64_t s = taken(i, k);
    const std::int64_t there = available(i, k);
    const std::int64_t w = solution_.used_up[i][k] ? 1 : 0;
    const std::int64_t u = solution_.most[k];
    const std::int64_t v = solution_.least[k];
    if (u < s) add("{}: u of {} = {}; expected at least {}, its labels", name, of, u, s);
    if (v > s + (top - there) * w)
      add("{}: v of {} = {}; expected at most {}", name, of, v, s + (top - there) * w);
    if (there * (1 - w) < there - s)
      add("{}: w of {} = {}; expected 0, because {} of {} labels are selected", name, of, w, s, there);
  }

  [[nodiscard]] std::int64_t taken(std::size_t i, std::size_t k) const {
    std::int64_t sum = 0;
    for (std::size_t j = 0; j < program_.videos[i].types.size(); ++j)
      sum += program_.videos[i].types[j].labels[k] * solution_.taken[i][j];
    return sum;
  }
  [[nodiscard]] std::int64_t available(std::size_t i, std::size_t k) const {
    std::int64_t sum = 0;
    for (const FrameType& type : program_.videos[i].types)
      sum += type.labels[k] * static_cast<std::int64_t>(type.frames.size());
    return sum;
  }

  template <typename... Values>
  void add(fmt::format_string<Values...> text, Values&&... values) {
    faults_.push_back(fmt::format(text, std::forward<Values>(values)...));
  }

  const BalanceProgram& program_;
  const BalanceSolution& solution_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> check_balance(const BalanceProgram& program, const BalanceSolution& solution) {
  if (!has_shape(program, solution)) return {"the solution belongs to another program"};
  return Checker(program, solution).check();
}

}  // namespace thermal
