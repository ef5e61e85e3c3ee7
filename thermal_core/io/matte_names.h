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

/// The number by which a cryptomatte tells a name: MurmurHash3_x86_32 of its UTF-8 with seed 0, the lowest bit of its
/// exponent turned over where it would make a float that is zero, denormal, infinite or NaN.
/// Source: Friedman and Jones, Fully automatic ID mattes with support for motion blur and transparency, SIGGRAPH 2015;
/// Cryptomatte specification 1.2.0; A. Appleby, MurmurHash3 (public domain).
[[nodiscard]] std::uint32_t cryptomatte_hash(std::string_view name) noexcept;

/// The last step of it: a hash as a float carries it. Blender's manifests have hashes as they were before.
[[nodiscard]] std::uint32_t hash_in_float(std::uint32_t hash) noexcept;

/// Whether a name is what a pattern says, * in it being any letters, also none.
[[nodiscard]] bool matches_matte(std::string_view pattern, std::string_view name) noexcept;

/// Which object each matte is of.
class MatteNames {
 public:
  struct Matte {
    std::string text;  ///< a name, or a pattern of names
    bool is_pattern = false;
    std::uint16_t index = 0;
    std::string object;
  };

  /// An object's mattes are those it lists; without a list, its name as it is. DataError if a text or, of names, a hash
  /// is two objects'.
  explicit MatteNames(std::span<const ManifestObject> objects);

  /// The matte of a name: itself, else the first pattern it is of. Nothing if there is none. DataError, to be read after
  /// the name, if it is of two objects' patterns.
  [[nodiscard]] const Matte* find(std::string_view name) const;

  /// The same for a hash whose name is not known: of the names alone.
  [[nodiscard]] const Matte* find_hash(std::uint32_t hash) const noexcept;

  /// All texts, as the manifest has them.
  [[nodiscard]] std::vector<std::string> texts() const;

 private:
  void add(Matte matte, const std::string& where);

  std::vector<Matte> mattes_;
  std::vector<std::string> where_;                        ///< of each, in the manifest
  std::unordered_map<std::string, std::size_t> by_text_;  ///< places in mattes_
  std::unordered_map<std::uint32_t, std::size_t> by_hash_;
};

}  // namespace thermal
