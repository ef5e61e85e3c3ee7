#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "labels/label_set.h"

namespace thermal {

/// Classes over which a data set is balanced: small, medium and large animals, then the same of poachers (people).
inline constexpr std::size_t kBalanceClasses = 6;

/// One number per class.
using ClassCounts = std::array<std::int64_t, kBalanceClasses>;

/// "small_animal" … "large_poacher", in the order of ClassCounts.
[[nodiscard]] const std::array<std::string, kBalanceClasses>& balance_class_names();

/// Frames of a video with the same number of labels of each class.
struct FrameType {
  ClassCounts labels{};
  std::vector<int> frames;  ///< indices in the video, from 0, ascending
};

/// A video, with its frames counted by type.
struct BalanceVideo {
  std::string name;
  std::vector<FrameType> types;  ///< each with at least one label, no two alike, in the order of their counts
  std::size_t unlabelled = 0;    ///< frames without a label of any class; they have no type

  /// Labels of each class in all its frames.
  [[nodiscard]] ClassCounts available() const noexcept;
};

/// The frame types of each video, in the order of set.videos. Ignored labels, crowds and vehicles belong to no class
/// and are not counted; their frames may still be selected for other labels.
[[nodiscard]] std::vector<BalanceVideo> frame_types(const LabelSet& set);

/// Bounds on the number of labels of a class in a data set.
struct ClassBounds {
  std::int64_t at_least = 0;
  std::int64_t at_most = 0;
};

/// Selects frames of some videos so that no class of targets comes from only a few of them: the mixed-integer program
/// of Bondi et al., COMPASS 2018. With k a class, i a video, j a frame type of it (labels c, N frames), x_ij the
/// number of frames selected, s_ik = sum_j c^k_ij x_ij their labels, of T_ik available:
///
///   minimise   sum_k (u_k - v_k)                       most labels of a class from any video, minus fewest from any
///   subject to u_k >= s_ik                             with labels left
///              v_k <= s_ik + (max_i T_ik - T_ik) w_ik
///              T_ik (1 - w_ik) >= T_ik - s_ik          w_ik: all of them are selected
///              0 <= x_ij <= N_ij, L^k_l <= sum_i s_ik <= L^k_u, x whole, w 0 or 1
///
/// The two constants are the paper's M, each as small as possible: with w = 0 the third row requires s >= 0, which T
/// ensures; with w = 1 it requires s = T, and the second row v <= max T. A larger v has no effect while a video has
/// labels left, because its s is below its T. A larger M is not only a weaker bound: where every video is exhausted,
/// v_k would be bounded by M alone, and exhausting videos would lower the objective. With these constants v_k = max T
/// = u_k in that case, so that v_k <= u_k always and the objective is never negative. A class that is selected
/// completely therefore costs nothing; only the upper bounds keep the selection from being everything.
struct BalanceProgram {
  std::vector<BalanceVideo> videos;
  std::array<ClassBounds, kBalanceClasses> bounds;
};

/// Values of all variables of the program.
struct BalanceSolution {
  std::vector<std::vector<std::int64_t>> taken;            ///< x: frames selected, by video and type
  ClassCounts most{};                                      ///< u
  ClassCounts least{};                                     ///< v
  std::vector<std::array<bool, kBalanceClasses>> used_up;  ///< w, by video
  std::int64_t objective = 0;

  /// s: labels in the frames of a video.
  [[nodiscard]] ClassCounts labels_of(const BalanceProgram& program, std::size_t video) const;
  [[nodiscard]] bool operator==(const BalanceSolution&) const = default;
};

/// How exact and how long a search is.
struct BalanceOptions {
  double gap = 0.01;         ///< largest accepted gap; 0: the optimum
  double time_limit_s = 60;  ///< wall clock

  /// ConfigError unless the gap is in 0 … 1 and the limit is above 0.
  void validate() const;
};

/// The best solution that was found, and how far from the optimum it can be.
struct BalanceResult {
  BalanceSolution solution;
  std::int64_t bound = 0;  ///< proven lower bound of the objective
  double gap = 0;          ///< (objective - bound) / max(1, objective)
  bool in_time = true;     ///< false: the time limit ended the search before it reached the gap
};

/// The solution with these frames: the best u, v and w for them.
[[nodiscard]] BalanceSolution complete_solution(const BalanceProgram& program,
                                                std::vector<std::vector<std::int64_t>> taken);

/// Faults of a solution: each constraint of the program that it violates, and its objective if it does not follow
/// from the variables. Empty if it is correct. Exact integer arithmetic on the videos and frames alone: it shares no
/// code with the solver and its models.
[[nodiscard]] std::vector<std::string> check_balance(const BalanceProgram& program,
                                                     const BalanceSolution& solution);

}  // namespace thermal
