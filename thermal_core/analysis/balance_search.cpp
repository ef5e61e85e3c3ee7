#include "analysis/balance_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "analysis/balance_check.h"
#include "analysis/balance_model.h"
#include "base/rng.h"

namespace thermal {
namespace {

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
