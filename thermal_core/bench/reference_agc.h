#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sensor/agc.h"

namespace thermal {

/// The AGC modes but clahe in double precision, on unrounded temperatures and without a table: the reference for Agc.
/// Histograms have bins of 0.04 K, like Agc's.
class ReferenceAgc {
 public:
  ReferenceAgc(const AgcParameters& parameters, const AgcScene& scene);

  /// Levels 0 to 255 of the next frame of the bench's scene, white-hot. Every temperature is finite and in (0, 655) K.
  [[nodiscard]] std::vector<int> next(const std::vector<double>& temperatures_k);

 private:
  void adapt(const std::vector<double>& temperatures_k);
  [[nodiscard]] double weight(const std::vector<double>& temperatures_k, std::size_t pixel) const;
  [[nodiscard]] std::vector<double> equalised(const std::vector<double>& temperatures_k, double low_k,
                                              double high_k) const;
  [[nodiscard]] double level(double temperature_k, double radiance_share) const;

  AgcParameters parameters_;
  AgcScene scene_;
  double share_of_new_;
  bool adapted_ = false;
  double low_k_;
  double high_k_;
  std::vector<double> levels_;  ///< plateau, information: at the lower edge of each bin
};

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
