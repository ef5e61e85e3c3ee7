#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/image.h"
#include "scene/manifest.h"
#include "scene/passes.h"

namespace thermal {

/// The hash of a name in a cryptomatte: MurmurHash3_x86_32 of its UTF-8 with seed 0, with the lowest bit of its
/// exponent flipped where it would make a float that is zero, denormal, infinite or NaN.
/// Source: Friedman and Jones, Fully automatic ID mattes with support for motion blur and transparency, SIGGRAPH
/// 2015; Cryptomatte specification 1.2.0; A. Appleby, MurmurHash3 (public domain).
[[nodiscard]] std::uint32_t cryptomatte_hash(std::string_view name) noexcept;

/// The last step of cryptomatte_hash(): a hash as stored in a float. Blender's manifests have hashes from before this
/// step.
[[nodiscard]] std::uint32_t hash_in_float(std::uint32_t hash) noexcept;

/// Whether a name matches a pattern, in which * matches any number of letters.
[[nodiscard]] bool matches_matte(std::string_view pattern, std::string_view name) noexcept;

/// Maps mattes to objects.
class MatteNames {
 public:
  /// A name in a cryptomatte, and the object that it stands for.
  struct Matte {
    std::string text;  ///< a name, or a pattern of names
    bool is_pattern = false;
    std::uint16_t index = 0;
    std::string object;
  };

  /// An object's mattes are those it lists; without a list, its name literally. DataError if two objects share a text
  /// or, of names, a hash.
  explicit MatteNames(std::span<const ManifestObject> objects);

  /// The object of a matte's name: an exact match, otherwise the first matching pattern. Empty if there is none.
  /// DataError, worded to follow the name, if it matches patterns of two objects.
  [[nodiscard]] const Matte* find(std::string_view name) const;

  /// The same for a hash of unknown name: exact names only.
  [[nodiscard]] const Matte* find_hash(std::uint32_t hash) const noexcept;

  /// All texts, as in the manifest.
  [[nodiscard]] std::vector<std::string> texts() const;

 private:
  void add(Matte matte, const std::string& where);

  std::vector<Matte> mattes_;
  std::vector<std::string> where_;                        ///< index of each in the manifest
  std::unordered_map<std::string, std::size_t> by_text_;  ///< indices into mattes_
  std::unordered_map<std::uint32_t, std::size_t> by_hash_;
};

/// The planes of a cryptomatte: hash, coverage, hash, coverage, …, all of one size, with the names of their channels.
struct MatteChannels {
  std::vector<std::string> names;
  std::vector<Plane<float>> planes;
};

/// Where and how often a hash has coverage.
struct MatteSpot {
  std::uint32_t hash = 0;
  std::string channel;
  int x_px = 0;
  int y_px = 0;
  std::int64_t pixels = 0;
};

/// Index of a hash's object; called once for each hash with coverage. Its exceptions pass through.
using MatteIndex = std::function<std::uint16_t(std::uint32_t hash)>;

/// First position where a hash has coverage, in row-major order and then by rank.
[[nodiscard]] MatteSpot spot_matte(const MatteChannels& mattes, std::uint32_t hash);

/// Fills object_index and ranks of Passes from a cryptomatte. Hashes of one object are summed, and a pixel's objects
/// sorted, most coverage first: files may list them otherwise (Cryptomatte specification, "Alternative ranking"), and
/// Blender 3.4.1 sometimes does. Hash 0 is nothing. Coverages with a sum above 1 are scaled to 1. object_index is rank
/// 0's, or sky where more is uncovered. DataError with channel and pixel for a coverage that is negative, infinite or
/// NaN.
void rank_mattes(const MatteChannels& mattes, const MatteIndex& index_of, Passes& passes);

}  // namespace thermal
