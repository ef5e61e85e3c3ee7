#include "analysis/balance_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace thermal {
namespace {

using ProgramTerms = std::vector<IntegerProgram::Term>;

/// The largest level in 0 … top for which `holds`, a predicate that is true up to some level and true at 0.
template <typename Holds>
std::int64_t last_level(std::int64_t top, const Holds& holds) {
  std::int64_t low = 0;
  while (low < top) {
    const std::int64_t middle = low + (top - low + 1) / 2;
    if (holds(middle))
      low = middle;
    else
      top = middle - 1;
  }
  return low;
}

class ModelMaker {
 public:
  ModelMaker(const BalanceProgram& program, const ModelShape& shape)
      : program_(program), shape_(shape), levels_(level_bounds(program)) {}

  BalanceModel make() && {
    for (std::size_t k = 0; k < kBalanceClasses; ++k) add_levels(k);
    for (std::size_t i = 0; i < program_.videos.size(); ++i) {
      model_.taken.emplace_back();
      model_.used_up.emplace_back();
      if (shape_.parts[i] == VideoPart::fixed)
        fix_video(i);
      else
        add_video(i);
    }
    for (std::size_t k = 0; k < kBalanceClasses; ++k) add_sum(k);
    if (shape_.objective_at_most < kUnbounded) add_objective_row();
    return std::move(model_);
  }

 private:
  void add_levels(std::size_t k) {
    const auto top = static_cast<double>(levels_.most_available[k]);
    most_[k] = model_.program.add(
        {.lower = static_cast<double>(levels_.most_at_least[k]), .upper = top, .cost = 1, .whole = true});
    least_[k] = model_.program.add(
        {.upper = static_cast<double>(levels_.least_at_most[k]), .cost = -1, .whole = true});
    add_row({.lower = 0, .terms = {{most_[k], 1}, {least_[k], -1}}});
  }

  /// A video with known frames bounds u and v, and its labels are subtracted from the sums.
  void fix_video(std::size_t i) {
    const ClassCounts there = program_.videos[i].available();
    ClassCounts labels{};
    for (std::size_t j = 0; j < program_.videos[i].types.size(); ++j) {
      for (std::size_t k = 0; k < kBalanceClasses; ++k)
        labels[k] += program_.videos[i].types[j].labels[k] * shape_.start[i][j];
    }
    for (std::size_t k = 0; k < kBalanceClasses; ++k) {
      const auto count = static_cast<double>(labels[k]);
      fixed_[k] += count;
      auto& most = model_.program.columns[most_[k]];
      auto& least = model_.program.columns[least_[k]];
      most.lower = std::max(most.lower, count);
      if (labels[k] < there[k]) least.upper = std::min(least.upper, count);
    }
  }

  void add_video(std::size_t i) {
    const BalanceVideo& video = program_.videos[i];
    const ClassCounts there = video.available();
    std::array<ProgramTerms, kBalanceClasses> labels;
    for (const FrameType& type : video.types) {
      const std::size_t column = model_.program.add(
          {.upper = static_cast<double>(type.frames.size()), .whole = shape_.parts[i] == VideoPart::whole});
      model_.taken[i].push_back(column);
      for (std::size_t k = 0; k < kBalanceClasses; ++k) {
        if (type.labels[k] > 0) labels[k].push_back({column, static_cast<double>(type.labels[k])});
      }
    }
    for (std::size_t k = 0; k < kBalanceClasses; ++k) {
      if (there[k] == 0) continue;
      sums_[k].insert(sums_[k].end(), labels[k].begin(), labels[k].end());
      add_rows_of(i, k, labels[k], there[k]);
    }
  }

  /// The rows of u, v and w for one video and class.
  void add_rows_of(std::size_t i, std::size_t k, const ProgramTerms& labels, std::int64_t there) {
    add_row({.upper = 0, .terms = with(labels, {most_[k], -1})});
    const std::int64_t beyond = levels_.least_at_most[k] - there;  // v_k never exceeds T_ik by more than
    ProgramTerms above_least = with(labels, {least_[k], -1});
    if (beyond > 0) {
      const std::optional<bool> known = shape_.used_up.empty() ? std::nullopt : shape_.used_up[i][k];
      const std::size_t column = model_.program.add({.lower = known.value_or(false) ? 1.0 : 0.0,
                                                     .upper = known.value_or(true) ? 1.0 : 0.0,
                                                     .whole = true});
      model_.used_up[i][k] = column;
      above_least.push_back({column, static_cast<double>(beyond)});
      add_row({.lower = 0, .terms = with(labels, {column, -static_cast<double>(there)})});
    }
    add_row({.lower = 0, .terms = std::move(above_least)});
  }

  void add_sum(std::size_t k) {
    if (shape_.elastic) {
      double price = 1;
      for (const std::int64_t top : levels_.most_available) price += static_cast<double>(top);
      sums_[k].push_back({model_.program.add({.cost = price}), 1});
      sums_[k].push_back({model_.program.add({.cost = price}), -1});
    }
    add_row({.lower = static_cast<double>(program_.bounds[k].at_least) - fixed_[k],
             .upper = static_cast<double>(program_.bounds[k].at_most) - fixed_[k],
             .terms = std::move(sums_[k])});
  }

  void add_objective_row() {
    ProgramTerms terms;
    for (std::size_t k = 0; k < kBalanceClasses; ++k) {
      terms.push_back({most_[k], 1});
      terms.push_back({least_[k], -1});
    }
    add_row({.upper = shape_.objective_at_most, .terms = std::move(terms)});
  }

  static ProgramTerms with(ProgramTerms terms, const IntegerProgram::Term& term) {
    terms.push_back(term);
    return terms;
  }
  void add_row(IntegerProgram::Row row) { model_.program.rows.push_back(std::move(row)); }

  const BalanceProgram& program_;
  const ModelShape& shape_;
  LevelBounds levels_;
  BalanceModel model_;
  std::array<std::size_t, kBalanceClasses> most_{};
  std::array<std::size_t, kBalanceClasses> least_{};
  std::array<ProgramTerms, kBalanceClasses> sums_;
  std::array<double, kBalanceClasses> fixed_{};
};

}  // namespace

std::vector<std::int64_t> BalanceModel::frames_in(const std::vector<double>& solution,
                                                  std::size_t video) const {
  std::vector<std::int64_t> frames;
  for (const std::size_t column : taken[video]) frames.push_back(std::llround(solution[column]));
  return frames;
}

FixedUse BalanceModel::used_up_in(const std::vector<double>& solution) const {
  FixedUse known(used_up.size());
  for (std::size_t i = 0; i < used_up.size(); ++i) {
    for (std::size_t k = 0; k < kBalanceClasses; ++k) {
      if (used_up[i][k]) known[i][k] = solution[*used_up[i][k]] > 0.5;
    }
  }
  return known;
}

LevelBounds level_bounds(const BalanceProgram& program) {
  std::vector<ClassCounts> available;
  for (const BalanceVideo& video : program.videos) available.push_back(video.available());
  LevelBounds levels;
  for (std::size_t k = 0; k < kBalanceClasses; ++k) {
    std::int64_t top = 0;
    for (const ClassCounts& there : available) top = std::max(top, there[k]);
    const auto sum_at = [&](std::int64_t level) {
      std::int64_t sum = 0;
      for (const ClassCounts& there : available) sum += std::min(there[k], level);
      return sum;
    };
    const ClassBounds& bounds = program.bounds[k];
    const auto falls_short = [&](std::int64_t level) {
      return level == 0 || sum_at(level - 1) < bounds.at_least;
    };
    levels.most_available[k] = top;
    levels.most_at_least[k] = last_level(top, falls_short);
    levels.least_at_most[k] = last_level(top, [&](auto level) { return sum_at(level) <= bounds.at_most; });
  }
  return levels;
}

BalanceModel make_model(const BalanceProgram& program, const ModelShape& shape) {
  return ModelMaker(program, shape).make();
}

}  // namespace thermal
