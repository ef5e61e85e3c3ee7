#include "analysis/balance_program.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {

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

}  // namespace thermal
