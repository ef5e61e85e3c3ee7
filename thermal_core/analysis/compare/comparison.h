#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/compare/discrimination.h"
#include "analysis/compare/measures.h"
#include "analysis/compare/set_figures.h"
#include "io/json/file.h"

namespace thermal {

/// Options of a comparison.
struct CompareOptions {
  FrameRequest real;
  FrameRequest other;
  int most_frames = 400;   ///< of each set
  std::uint32_t seed = 1;  ///< of the halvings and of the classifiers
  std::function<void(std::size_t done, std::size_t total)> show = {};  ///< called as frames are measured

  /// ConfigError unless `most_frames` is at least 4.
  void validate() const;
};

/// A difference is good up to this many times the difference between two halves of the real frames.
inline constexpr double kGoodRatio = 2;

/// One measure of both sets.
struct ComparedMeasure {
  std::optional<double> real;
  std::optional<double> other;
  std::optional<double> difference;  ///< other minus real
  std::optional<double>
      real_difference;          ///< between halves of the real frames: mean magnitude over all halvings
  std::optional<double> ratio;  ///< of the magnitudes; empty also if halves never differ

  [[nodiscard]] bool is_good() const;  ///< within kGoodRatio, or no difference at all
};

/// How well a classifier separates real from made frames or crops.
struct Classification {
  Discrimination sets;  ///< real against other
  std::optional<Discrimination>
      real_halves;                        ///< real against real, averaged over halvings; empty: too few units
  std::vector<double> halves_alone = {};  ///< the AUC of each feature alone, likewise; empty likewise
};

/// All differences between two sets of frames.
struct Comparison {
  SetFigures real;
  SetFigures other;
  std::vector<ComparedMeasure> measures;  ///< in the order of measures()
  std::optional<Classification> frames;
  std::optional<Classification> crops;  ///< empty: fewer than two units with crops in a set
};

/// Reads, measures and compares two sets of frames. The result depends on the frames, labels and options alone.
/// Faults are those of read_frame_source() and measure_set().
[[nodiscard]] Comparison compare(const CompareOptions& options);

/// Two halves of frames, by units in a random order; the first half has one unit more if they are odd.
struct Halves {
  MeasuredFrames first;
  MeasuredFrames second;
};
/// Random halves of a set's frames; the draw depends on `seed` and `draw` alone.
[[nodiscard]] Halves halves_of(const std::vector<FrameFigures>& frames, std::uint32_t seed,
                               std::uint32_t draw);

/// How noise was measured in a set, as a sentence without a full stop.
[[nodiscard]] std::string noise_method(const SetFigures& set);

/// A comparison as JSON, with all that is printed; unknown values are null. With `each`, also the figures of each frame
/// and target.
[[nodiscard]] Json to_json(const Comparison& comparison, bool each);

}  // namespace thermal
