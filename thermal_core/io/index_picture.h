#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "io/files.h"
#include "io/pass_reader.h"
#include "io/picture_rows.h"
#include "scene/manifest.h"
#include "scene/passes.h"

namespace thermal {

/// Whether a file is read as a picture of indices or colours: by its name's end (.png, in any case).
[[nodiscard]] bool is_index_picture(const Path& file);

/// Reads pictures of object indices: grey PNGs, whose numbers are the indices, and PNGs of colours or with a palette,
/// whose colours are those of the manifest's objects. Where objects have colours, grey of up to 8 bits is a colour too,
/// its three channels being alike. What is wholly transparent is sky. They have no other plane.
class IndexPictures {
 public:
  /// DataError if two objects have one colour, or one that of the sky.
  explicit IndexPictures(const Manifest& manifest, const ReadLimits& limits = {});

  /// DataError naming file and pixel for a colour that is no object's, an index above 32767, partial transparency,
  /// another size than the manifest's, and for planes that are needed and not there; IoError if it can't be read.
  [[nodiscard]] Passes read(const Path& file, const PassNeeds& needs) const;

 private:
  void check_size(const PngHeader& header) const;

  int width_px_;
  int height_px_;
  ReadLimits limits_;
  bool has_colours_ = false;                                   ///< of objects
  std::unordered_map<std::uint32_t, std::uint16_t> index_of_;  ///< by red << 16 | green << 8 | blue
};

/// A number or a colour of a picture, and its pixels.
struct PictureUse {
  int value = 0;    ///< of grey pictures
  Colour colour{};  ///< of coloured ones
  std::int64_t pixels = 0;
};

/// What a picture holds.
struct PictureSurvey {
  PictureKind kind = PictureKind::grey8;
  int width_px = 0;
  int height_px = 0;
  std::vector<PictureUse> uses;         ///< most pixels first, then by value
  std::int64_t transparent_pixels = 0;  ///< wholly or in part; they are not among `uses`
  std::int64_t other_pixels = 0;        ///< of further colours than `uses` has room for
};

/// A survey tells so many numbers or colours apart.
inline constexpr std::size_t kMostPictureUses = 65536;

/// Looks at any picture of a kind that IndexPictures reads. DataError naming the file if it is damaged, of another kind, or
/// claims more pixels than the limits or its length allow; IoError if it can't be read.
[[nodiscard]] PictureSurvey survey_picture(const Path& file, const ReadLimits& limits = {});

}  // namespace thermal
