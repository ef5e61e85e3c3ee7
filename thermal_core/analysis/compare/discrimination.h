#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace thermal {

/// Features of frames or crops of one set. Rows of one unit belong together: a classifier learns from all or none.
struct FeatureTable {
  std::vector<std::vector<std::optional<double>>> rows;
  std::vector<std::size_t> units;  ///< of the rows; numbers from 0
};

/// Whether its rows are of two units or more.
[[nodiscard]] bool has_two_units(const FeatureTable& table);

/// Those values of a feature that are known.
[[nodiscard]] std::vector<double> known_values(const FeatureTable& table, std::size_t feature);

/// Area under the curve of one feature alone, whichever way its known values differ: .5 or more.
[[nodiscard]] double told_alone(const FeatureTable& first, const FeatureTable& second, std::size_t feature);

/// What a feature contributes.
struct Importance {
  std::size_t feature = 0;
  double fall =
      0;  ///< of the area under the curve when its values are shuffled among the rows that are tested
  double alone = 0.5;  ///< told_alone()
};

/// How well a classifier separates two sets.
struct Discrimination {
  double auc =
      0.5;  ///< area under the receiver operating characteristic: .5 if it cannot, 1 if it always can
  double error = 0;  ///< standard error (Hanley and McNeil 1982), with a unit for a case
  std::vector<Importance> importances = {};  ///< by fall, then by what they tell alone
};

/// A random forest (OpenCV's) of 100 trees, cross-validated in five parts of whole units, or fewer if a set has fewer
/// units. Pairs within a part are compared; so a part's own level does not matter. Unknown values count as the median.
/// Features that say the same stand in for each other: none falls by much then, and the AUC of each alone says more. The result depends on `seed` and the tables alone. At most
/// 400 rows of each table are used, evenly spaced.
/// Both tables need two units or more.
[[nodiscard]] Discrimination discriminate(const FeatureTable& first, const FeatureTable& second,
                                          std::size_t features, std::uint32_t seed);

/// Share of pairs in which the positive has the higher score; equal scores count half. `pairs` says of how many.
struct WonPairs {
  double won = 0;
  double pairs = 0;
};
/// Counts them over all pairs of a negative and a positive score; equal ones are half won.
[[nodiscard]] WonPairs won_pairs(const std::vector<double>& negative, const std::vector<double>& positive);

/// Units in a random order, which depends on `seed` and `draw` alone.
[[nodiscard]] std::vector<std::size_t> shuffled(std::size_t count, std::uint32_t seed, std::uint32_t draw);

}  // namespace thermal
