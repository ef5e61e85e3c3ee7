#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/balance_program.h"
#include "analysis/balance_solver.h"

namespace thermal {

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

/// The balance program (balance.h), with the same optimal solutions in a smaller search space: u and v are whole and
/// within the level bounds, v <= u, and M of the second row is the most by which v may exceed T_ik, max(0, bound of v
/// - T_ik), without w where that is 0. Solutions are completed and checked against the published program.
[[nodiscard]] BalanceModel make_model(const BalanceProgram& program, const ModelShape& shape);

}  // namespace thermal
