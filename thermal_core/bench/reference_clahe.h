#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sensor/agc.h"

namespace thermal {

/// The AGC mode clahe in double precision, on unrounded temperatures of the bench's scene, without tables: the
/// reference for LocalTone. Histograms have bins of 0.04 K, like LocalTone's.
class ReferenceClahe {
 public:
  ReferenceClahe(const AgcParameters& parameters, const AgcScene& scene);

  /// Levels 0 to 255 of the next frame, white-hot, row by row.
  [[nodiscard]] std::vector<int> next(const std::vector<double>& temperatures_k);

 private:
  using Levels = std::vector<double>;  ///< at the lower edge of each bin

  [[nodiscard]] Levels equalised(const std::vector<double>& tile_k) const;
  [[nodiscard]] std::vector<double> tile(const std::vector<double>& temperatures_k, int column,
                                         int row) const;
  [[nodiscard]] double level(int column, int row, double temperature_k) const;

  AgcParameters parameters_;
  AgcScene scene_;
  double share_of_new_ = 1;
  std::vector<Levels> levels_;  ///< of tiles, row by row
};

}  // namespace thermal
