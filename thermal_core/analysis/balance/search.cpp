#include "analysis/balance/search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/balance/solver.h"
#include "base/rng.h"

namespace thermal {
namespace {

/// Limits of u_k and v_k that follow from the bounds alone, before anything is solved.
struct LevelBounds {
  ClassCounts most_at_least{};   ///< u_k >= the level that sum_i min(T_ik, level) reaches L^k_l at
  ClassCounts least_at_most{};   ///< v_k <= the last level at which sum_i min(T_ik, level) is within L^k_u
  ClassCounts most_available{};  ///< max_i T_ik
};
/// Those of a program.
[[nodiscard]] LevelBounds level_bounds(const BalanceProgram& program);

/// How a model represents a video.
enum class VideoPart {
  whole,    ///< whole numbers of frames
  relaxed,  ///< any numbers of frames
  fixed,    ///< the frames of the start
};

/// Known values of w, by video; empty where unknown.
using FixedUse = std::vector<std::array<std::optional<bool>, kBalanceClasses>>;

/// What to build a model from.
struct ModelShape {
  std::vector<VideoPart> parts;                       ///< one per video
  std::vector<std::vector<std::int64_t>> start = {};  ///< frames of fixed videos; others are not read
  FixedUse used_up = {};
  bool elastic = false;  ///< bounds of the classes may be violated, at a cost above any objective
  double objective_at_most = kUnbounded;
};

/// A program for the solver, and the positions of its variables.
struct BalanceModel {
  IntegerProgram program;
  std::vector<std::vector<std::size_t>> taken;  ///< columns of x, by video; empty for fixed ones
  std::vector<std::array<std::optional<std::size_t>, kBalanceClasses>>
      used_up;  ///< of w, where it has an effect

  /// Frames of a solution from a video that is not fixed.
  [[nodiscard]] std::vector<std::int64_t> frames_in(const std::vector<double>& solution,
                                                    std::size_t video) const;
  [[nodiscard]] FixedUse used_up_in(const std::vector<double>& solution) const;
};

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

/// The balance program (balance.h), with the same optimal solutions in a smaller search space: u and v are whole and
/// within the level bounds, v <= u, and M of the second row is the most by which v may exceed T_ik, max(0, bound of v
/// - T_ik), without w where that is 0. Solutions are completed and checked against the published program.
BalanceModel make_model(const BalanceProgram& program, const ModelShape& shape) {
  return ModelMaker(program, shape).make();
}

using Frames = std::vector<std::vector<std::int64_t>>;

constexpr std::size_t kVideosABlock = 4;  // videos rounded together
constexpr int kBlockNodes = 200;          // of the search tree of a block
constexpr int kPasses = 8;

/// Orders of videos in which a pass rounds them: fewest frame types first, most first, then random. The videos
/// rounded last have the least freedom, and which order suits the data is not known in advance.
std::vector<std::size_t> order_of_pass(const BalanceProgram& program, int pass) {
  const auto key = [&](std::size_t i) -> std::uint64_t {
    const std::uint64_t types = program.videos[i].types.size();
    if (pass < 2) return pass == 0 ? types : ~types;
    return Philox4x32::generate({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(pass), 0, 0},
                                {})[0];
  };
  std::vector<std::size_t> order(program.videos.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto one, auto other) { return key(one) < key(other); });
  return order;
}

/// Bounds first, then solutions, then both. With fractional numbers of frames the program is solved in seconds; because
/// videos have many frames, its objective is a bound within a few labels of the optimum. The videos that it exhausts
/// are fixed, and frames are rounded a few videos at a time, exactly, while later videos remain free. The solver closes
/// the rest of the gap with the whole program.
class Search {
 public:
  Search(const BalanceProgram& program, Frames taken, double gap, const Deadline& deadline)
      : program_(program),
        gap_(gap),
        deadline_(deadline),
        best_(complete_solution(program, std::move(taken))) {}

  BalanceResult run() && {
    relax();
    const int passes = program_.videos.size() > kVideosABlock ? kPasses : 0;  // one block would be the whole
    for (int pass = 0; pass < passes && !is_done() && deadline_.left_s() > 0; ++pass) round_in_blocks(pass);
    if (!is_done() && deadline_.left_s() > 0) solve_whole();
    return {.solution = best_, .bound = bound_, .gap = gap_to_bound(), .in_time = is_done()};
  }

 private:
  [[nodiscard]] double gap_to_bound() const {
    return static_cast<double>(best_.objective - bound_) /
           static_cast<double>(std::max<std::int64_t>(1, best_.objective));
  }
  [[nodiscard]] bool is_done() const { return gap_to_bound() <= gap_; }

  void relax() {
    const BalanceModel model =
        make_model(program_, {.parts = std::vector(program_.videos.size(), VideoPart::relaxed)});
    const SolverResult solved = solve(model.program, {.gap = gap_ / 10, .time_s = deadline_.left_s() / 2});
    if (solved.end != SolverEnd::infeasible) raise_bound(solved.bound);
    if (!solved.values.empty()) used_up_ = model.used_up_in(solved.values);
  }

  /// The bounds of the classes may be violated meanwhile; a final solution that violates them is discarded.
  void round_in_blocks(int pass) {
    if (used_up_.empty()) return;
    const std::vector<std::size_t> order = order_of_pass(program_, pass);
    ModelShape shape{.parts = std::vector(order.size(), VideoPart::relaxed),
                     .start = best_.taken,
                     .used_up = used_up_,
                     .elastic = true};
    for (std::size_t begin = 0; begin < order.size(); begin += kVideosABlock) {
      const std::size_t end = std::min(begin + kVideosABlock, order.size());
      for (std::size_t index = begin; index < end; ++index) shape.parts[order[index]] = VideoPart::whole;
      const BalanceModel model = make_model(program_, shape);
      const SolverResult solved = solve(model.program, {.time_s = deadline_.left_s(), .nodes = kBlockNodes});
      if (solved.values.empty()) return;
      for (std::size_t index = begin; index < end; ++index) {
        shape.start[order[index]] = model.frames_in(solved.values, order[index]);
        shape.parts[order[index]] = VideoPart::fixed;
      }
    }
    keep_better(std::move(shape.start));
  }

  /// Searches only for solutions better than the best by more than the gap; if there are none, the gap is proven.
  void solve_whole() {
    const double enough = static_cast<double>(best_.objective) * (1 - gap_);
    const std::int64_t sought = static_cast<std::int64_t>(std::ceil(enough - 1e-9)) - 1;
    const BalanceModel model =
        make_model(program_, {.parts = std::vector(program_.videos.size(), VideoPart::whole),
                              .objective_at_most = static_cast<double>(sought)});
    const SolverResult solved = solve(model.program, {.gap = gap_, .time_s = deadline_.left_s()});
    raise_bound(solved.end == SolverEnd::infeasible
                    ? static_cast<double>(sought + 1)
                    : std::min(solved.bound, static_cast<double>(sought + 1)));
    if (solved.values.empty()) return;
    Frames taken;
    for (std::size_t i = 0; i < program_.videos.size(); ++i)
      taken.push_back(model.frames_in(solved.values, i));
    keep_better(std::move(taken));
  }

  /// Objectives are whole numbers, but the solver's arithmetic is not exact.
  void raise_bound(double bound) {
    if (!std::isfinite(bound)) return;
    const double slack = 1e-6 * std::max(1.0, std::abs(bound));
    const double whole = std::min(std::ceil(bound - slack), static_cast<double>(best_.objective));
    bound_ = std::max(bound_, static_cast<std::int64_t>(whole));
  }

  void keep_better(Frames taken) {
    BalanceSolution solution = complete_solution(program_, std::move(taken));
    if (solution.objective < best_.objective && check_balance(program_, solution).empty())
      best_ = std::move(solution);
  }

  const BalanceProgram& program_;
  double gap_;
  const Deadline& deadline_;
  BalanceSolution best_;
  std::int64_t bound_ = 0;  // the objective is never negative: balance.h
  FixedUse used_up_;
};

}  // namespace

BalanceResult search_balance(const BalanceProgram& program, Frames taken, double gap,
                             const Deadline& deadline) {
  return Search(program, std::move(taken), gap, deadline).run();
}

}  // namespace thermal
