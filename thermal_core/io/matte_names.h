#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scene/manifest.h"

namespace thermal {

/// The hash of a name in a cryptomatte: MurmurHash3_x86_32 of its UTF-8 with seed 0, with the lowest bit of its
/// exponent flipped where it would make a float that is zero, denormal, infinite or NaN.
/// Source: Friedman and Jones, Fully automatic ID mattes with support for motion blur and transparency, SIGGRAPH
/// 2015; Cryptomatte specification 1.2.0; A. Appleby, MurmurHash3 (public domain).
[[nodiscard]] std::uint32_t cryptomatte_hash(std::string_view name) noexcept;

/// Its last step: a hash as stored in a float. Blender's manifests have hashes from before this step.
[[nodiscard]] std::uint32_t hash_in_float(std::uint32_t hash) noexcept;

/// Whether a name matches a pattern, in which * matches any letters, or none.
[[nodiscard]] bool matches_matte(std::string_view pattern, std::string_view name) noexcept;

/// Maps mattes to objects.
class MatteNames {
 public:
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

}  // namespace thermal
