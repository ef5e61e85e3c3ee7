#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace thermal {

/// Features of frames or crops of one set. Rows of one unit are never split between training and test.
struct FeatureTable {
  std::vector<std::vector<std::optional<double>>> rows;
  std::vector<std::size_t> units;  ///< of the rows; numbers from 0
};

/// Whether its rows are of two units or more.
[[nodiscard]] bool has_two_units(const FeatureTable& table);

/// The known values of a feature.
[[nodiscard]] std::vector<double> known_values(const FeatureTable& table, std::size_t feature);

/// Area under the curve of one feature alone, in the direction that separates better: .5 or more.
[[nodiscard]] double separation_alone(const FeatureTable& first, const FeatureTable& second,
                                      std::size_t feature);

/// Contribution of a feature.
struct Importance {
  std::size_t feature = 0;
  double fall = 0;  ///< decrease of the area under the curve when its values are shuffled among the test rows
  double alone = 0.5;  ///< separation_alone()
};

/// Separability of two sets by a classifier.
struct Discrimination {
  double auc = 0.5;  ///< area under the receiver operating characteristic: .5 no separation, 1 complete
  double error = 0;  ///< standard error (Hanley and McNeil 1982), with one case per unit
  std::vector<Importance> importances = {};  ///< by decrease, then by `alone`
};

/// A random forest (OpenCV's) of 100 trees, cross-validated in five parts of whole units, or fewer if a set has fewer
/// units. Only scores within a part are compared, because levels differ between parts. Unknown values count as the
/// median. Redundant features replace each other: none decreases much when shuffled, and the AUC of each alone is more
/// informative. The result depends on `seed` and the tables alone. At most 400 rows of each table are used, evenly
/// spaced. Both tables need two units or more.
[[nodiscard]] Discrimination discriminate(const FeatureTable& first, const FeatureTable& second,
                                          std::size_t features, std::uint32_t seed);

/// Share of pairs in which the positive has the higher score; equal scores count half. `pairs` is their number.
struct WonPairs {
  double won = 0;
  double pairs = 0;
};
/// Counts them over all pairs of a negative and a positive score; equal ones are half won.
[[nodiscard]] WonPairs won_pairs(const std::vector<double>& negative, const std::vector<double>& positive);

/// Units in a random order, which depends on `seed` and `draw` alone.
[[nodiscard]] std::vector<std::size_t> shuffled(std::size_t count, std::uint32_t seed, std::uint32_t draw);

}  // namespace thermal
