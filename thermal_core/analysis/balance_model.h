#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/balance.h"
#include "analysis/balance_solver.h"

namespace thermal {

/// What the bounds alone say of u_k and v_k, before anything is solved.
struct LevelBounds {
  ClassCounts most_at_least{};   ///< u_k >= the level that sum_i min(T_ik, level) reaches L^k_l at
  ClassCounts least_at_most{};   ///< v_k <= the last level at which sum_i min(T_ik, level) is within L^k_u
  ClassCounts most_available{};  ///< max_i T_ik
};
[[nodiscard]] LevelBounds level_bounds(const BalanceProgram& program);

/// How a video takes part in a model.
enum class VideoPart {
  whole,    ///< whole numbers of frames
  relaxed,  ///< any numbers of frames
  fixed,    ///< those of a start
};

/// Values of w that are known, by video; none where that is empty.
using FixedUse = std::vector<std::array<std::optional<bool>, kBalanceClasses>>;

/// What a model is to be made of.
struct ModelShape {
  std::vector<VideoPart> parts;                       ///< one a video
  std::vector<std::vector<std::int64_t>> start = {};  ///< frames of fixed videos; others' are not looked at
  FixedUse used_up = {};
  bool elastic = false;  ///< bounds of the classes may be broken, at a price above any objective
  double objective_at_most = kUnbounded;
};

/// A program for the solver, and where its variables are.
struct BalanceModel {
  IntegerProgram program;
  std::vector<std::vector<std::size_t>> taken;  ///< columns of x, by video; none for fixed ones
  std::vector<std::array<std::optional<std::size_t>, kBalanceClasses>>
      used_up;  ///< of w, where it says something

  /// What a solution takes of a video that is not fixed.
  [[nodiscard]] std::vector<std::int64_t> frames_in(const std::vector<double>& solution,
                                                    std::size_t video) const;
  [[nodiscard]] FixedUse used_up_in(const std::vector<double>& solution) const;
};

/// The balance program (balance.h), with the same best solutions in less room: u and v are whole and within the level
/// bounds, v <= u, and M of the second row is what v may exceed T_ik by, max(0, bound of v - T_ik), without w where that
/// is 0. What the solver finds in it is completed and checked as the published program's.
[[nodiscard]] BalanceModel make_model(const BalanceProgram& program, const ModelShape& shape);

}  // namespace thermal
