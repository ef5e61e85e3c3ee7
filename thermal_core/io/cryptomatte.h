#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/exr_passes.h"
#include "io/matte_names.h"
#include "scene/manifest.h"

namespace thermal {

/// A cryptomatte that an EXR file's headers tell of.
struct Cryptomatte {
  std::string name;                            ///< as its metadata has it, such as "ViewLayer.CryptoObject"
  std::map<std::uint32_t, std::string> names;  ///< of its manifest, by hash; empty: it has none in the file
  std::vector<const ExrChannel*> channels;     ///< hash, coverage, hash, coverage, …: two a rank
  std::string names_fault;                     ///< why there are none although it has a manifest; or empty
  std::string fault;  ///< why it cannot be read, without the file's name; empty: it can
};

/// All there are, by name; their channels point into `header`. Reads no pixels and never fails: what is wrong with one
/// is in its `fault`. A manifest that is no JSON does not keep its cryptomatte from being read, since names can be
/// hashed: Blender 3.4 writes such ones, of names with quotes. Manifests in files beside (manif_file) are not looked for.
/// Source: Cryptomatte specification 1.2.0, "EXR File".
[[nodiscard]] std::vector<Cryptomatte> cryptomattes_in(const ExrHeader& header);

/// The one that is meant by its whole name, or by what follows its layer's ("CryptoObject"); of several, that of
/// `layer`. DataError, telling what there is, if there is none, or several, and with its fault if it cannot be read.
[[nodiscard]] const Cryptomatte& choose_cryptomatte(std::span<const Cryptomatte> cryptomattes,
                                                    const std::string& wanted, const std::string& layer);

/// One hash of a cryptomatte and how much of the picture is its.
struct MatteUse {
  std::uint32_t hash = 0;  ///< 0: nothing
  std::string name;        ///< empty: the file does not tell
  std::int64_t pixels = 0;
};

/// A survey tells so many hashes apart; the pixels of further ones are not counted.
inline constexpr std::size_t kMostMattes = 65536;

/// The hashes of rank 0, which covers most of each pixel: most pixels first, then by hash. DataError with its fault for a
/// cryptomatte that cannot be read, IoError for a file.
[[nodiscard]] std::vector<MatteUse> survey_mattes(const Path& file, const ExrHeader& header,
                                                  const Cryptomatte& cryptomatte,
                                                  const ExrLimits& limits = {});

/// What the hashes of a clip's cryptomatte mean.
class MatteTable {
 public:
  /// DataError if a matte's name stands for several objects.
  explicit MatteTable(const Manifest& manifest);

  /// Reads one frame as PassReader does, but for actors alone, by rank_mattes(). Its material plane, which knows one surface a pixel, is that
  /// of rank 0.
  /// A hash that is no object's is a DataError with its pixel, its name if the file tells it, and what was expected.
  [[nodiscard]] Passes read(const Path& file, const ExrLayout& layout, const PassNeeds& needs) const;

  /// Which planes beside the cryptomatte this file has; reads no pixels. The same faults.
  [[nodiscard]] PassNeeds planes_in(const Path& file, const ExrLayout& layout) const;

 private:
  std::string cryptomatte_;
  MatteNames names_;
};

}  // namespace thermal
