#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "analysis/frame_types.h"

namespace thermal {

/// How many labels of a class a data set is to have.
struct ClassBounds {
  std::int64_t at_least = 0;
  std::int64_t at_most = 0;
};

/// Which frames to take of some videos, so that no class of targets comes from few of them: the mixed-integer program
/// of Bondi et al., COMPASS 2018. With k a class, i a video, j a frame type of it (labels c, N frames), x_ij the frames
/// to take, s_ik = sum_j c^k_ij x_ij the labels they bring, of T_ik that are there:
///
///   minimise   sum_k (u_k - v_k)                       most labels of a class from any video, least from any that has
///   subject to u_k >= s_ik                             more to give
///              v_k <= s_ik + (max_i T_ik - T_ik) w_ik
///              T_ik (1 - w_ik) >= T_ik - s_ik          w_ik: all of them are taken
///              0 <= x_ij <= N_ij, L^k_l <= sum_i s_ik <= L^k_u, x whole, w 0 or 1
///
/// The two constants are the paper's M, each the least that is large enough: with w = 0 the third row asks for s >= 0,
/// which T ensures; with w = 1 it asks for s = T, and the second row for v <= max T, beyond which v is of no use while
/// a video has more to give, its s being below its T. A larger M is not only looser: where every video is used up, v_k
/// is bounded by M alone, and the objective would be paid to use up. As it is, v_k = max T = u_k there, and so
/// v_k <= u_k always, and no objective is below 0. So a class that is taken whole costs nothing: it is the upper bounds
/// that keep a selection from being everything.
struct BalanceProgram {
  std::vector<BalanceVideo> videos;
  std::array<ClassBounds, kBalanceClasses> bounds;
};

/// All variables of the program.
struct BalanceSolution {
  std::vector<std::vector<std::int64_t>> taken;            ///< x: frames to take, by video and type
  ClassCounts most{};                                      ///< u
  ClassCounts least{};                                     ///< v
  std::vector<std::array<bool, kBalanceClasses>> used_up;  ///< w, by video
  std::int64_t objective = 0;

  /// s: labels that a video's frames bring.
  [[nodiscard]] ClassCounts labels_of(const BalanceProgram& program, std::size_t video) const;
  [[nodiscard]] bool operator==(const BalanceSolution&) const = default;
};

struct BalanceOptions {
  double gap = 0.01;         ///< that will do; 0: the best there is
  double time_limit_s = 60;  ///< wall clock

  /// ConfigError unless the gap is in 0 … 1 and the limit above 0.
  void validate() const;
};

struct BalanceResult {
  BalanceSolution solution;
  std::int64_t bound = 0;  ///< no solution's objective is smaller: proven
  double gap = 0;          ///< (objective - bound) / max(1, objective)
  bool in_time = true;     ///< false: the time limit ended the search before the gap was reached
};

/// Solves the program to within a gap, and checks every constraint of the solution with check_balance().
/// ConfigError if the bounds cannot be met, with those that can come nearest (nearest_bounds()), or if no solution is
/// found in time. The same program gives the same solution, unless time ran out.
[[nodiscard]] BalanceResult balance(const BalanceProgram& program, const BalanceOptions& options);

/// The solution that takes these frames: the best u, v and w for them.
[[nodiscard]] BalanceSolution complete_solution(const BalanceProgram& program,
                                                std::vector<std::vector<std::int64_t>> taken);

}  // namespace thermal
