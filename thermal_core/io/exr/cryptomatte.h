#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/exr/header.h"
#include "io/exr/mattes.h"
#include "io/exr/passes.h"
#include "scene/manifest.h"

namespace thermal {

/// A cryptomatte declared in the headers of an EXR file.
struct Cryptomatte {
  std::string name;                            ///< as in its metadata, such as "ViewLayer.CryptoObject"
  std::map<std::uint32_t, std::string> names;  ///< from its manifest, by hash; empty: it has none
  std::vector<const ExrChannel*> channels;     ///< hash, coverage, hash, coverage, …: two per rank
  std::string names_fault;                     ///< why `names` is empty although it has a manifest; or empty
  std::string fault;  ///< why it cannot be read, without the file's name; empty if it can be read
};

/// All cryptomattes of a file, by name; their channels point into `header`. Reads no pixels and never fails: faults
/// are in `fault`. An invalid JSON manifest does not prevent reading, because names can be hashed: Blender 3.4 writes
/// invalid ones for names with quotes.
/// Of the metadata, name, hash, conversion, manifest and manif_file are used, and others ignored. A manifest in the header
/// comes before the side-car file that manif_file names: a relative name below the EXR file's folder, of a regular file of at
/// most kMostSidecarBytes, not through links.
/// Source: Cryptomatte specification 1.2.0, "EXR File".
[[nodiscard]] std::vector<Cryptomatte> cryptomattes_in(const ExrHeader& header);

/// Largest side-car manifest that is read: half a million names.
inline constexpr std::size_t kMostSidecarBytes = std::size_t{16} << 20;

/// The side-car files that the cryptomattes of a file name, by key; without those whose names are refused.
[[nodiscard]] std::vector<Path> sidecars_of(const ExrHeader& header);

/// Selects by whole name, or by the part after the layer's name ("CryptoObject"); among several, that of `layer`.
/// DataError with the available ones if there is none or several, and with its fault if it cannot be read.
[[nodiscard]] const Cryptomatte& choose_cryptomatte(std::span<const Cryptomatte> cryptomattes,
                                                    const std::string& wanted, const std::string& layer);

/// One hash of a cryptomatte and its area in the picture.
struct MatteUse {
  std::uint32_t hash = 0;  ///< 0: nothing
  std::string name;        ///< empty: the file does not name it
  std::int64_t pixels = 0;
};

/// Limit of different hashes in a survey; pixels of further hashes are not counted.
inline constexpr std::size_t kMostMattes = 65536;

/// The hashes of rank 0, which covers most of each pixel: most pixels first, then by hash. DataError with its fault
/// if the cryptomatte is unreadable, IoError for the file.
[[nodiscard]] std::vector<MatteUse> survey_mattes(const Path& file, const ExrHeader& header,
                                                  const Cryptomatte& cryptomatte,
                                                  const ExrLimits& limits = {});

/// The meaning of the hashes of a clip's cryptomatte.
class MatteTable {
 public:
  /// DataError if a matte's name matches several objects.
  explicit MatteTable(const Manifest& manifest);

  /// Reads one frame as PassReader does, but with actors only, by rank_mattes(). Its material plane, which has one
  /// surface per pixel, is that of rank 0. A hash that matches no object is a DataError with its pixel, its name if
  /// the file has it, and what was expected.
  [[nodiscard]] Passes read(const Path& file, const ExrLayout& layout, const PassNeeds& needs) const;

  /// Which planes besides the cryptomatte this file has; reads no pixels. The same faults.
  [[nodiscard]] PassNeeds planes_in(const Path& file, const ExrLayout& layout) const;

 private:
  std::string cryptomatte_;
  MatteNames names_;
};

}  // namespace thermal
