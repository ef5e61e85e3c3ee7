#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

#include "io/image/png.h"
#include "io/pass_buffer.h"
#include "io/system/files.h"
#include "scene/manifest.h"
#include "scene/passes.h"

namespace thermal {

/// Meaning of the pixels of a picture.
enum class PictureKind { grey8, grey16, colour };

/// One pixel of a picture: a number, or a colour with 8 bits per channel. Alpha is 255 if opaque, 65535 in 16-bit
/// pictures.
struct PicturePixel {
  std::uint16_t grey = 0;
  Colour colour{};
  std::uint16_t alpha = 0;
};

/// The kind of a picture with this header. DataError (without the file's name) for colours with 16 bits per channel.
[[nodiscard]] PictureKind kind_of(const PngHeader& header);

/// Called with each row, from the top.
using TakeRow = std::function<void(int y, std::span<const PicturePixel> row)>;

/// Reads the samples of a PNG as stored: no gamma, no premultiplication; palettes are looked up. DataError "damaged:
/// …" (without the file's name) if it is incomplete; some rows may have been delivered by then.
void read_rows(PngFile& file, const TakeRow& take);

/// Whether a file is read as a picture of indices or colours: by its extension (.png, in any case).
[[nodiscard]] bool is_index_picture(const Path& file);

/// Reads pictures of object indices: grey PNGs, whose numbers are the indices, and PNGs of colours or with a palette,
/// whose colours are those of the manifest's objects. If objects have colours, grey of up to 8 bits is read as a
/// colour with three equal channels. Fully transparent pixels are sky. These pictures have no other planes.
class IndexPictures {
 public:
  /// DataError if two objects have one colour, or an object has the sky's.
  explicit IndexPictures(const Manifest& manifest, const ReadLimits& limits = {});

  /// DataError with file and pixel for a colour that matches no object, an index above 32767, partial transparency, a
  /// size other than the manifest's, and needed planes other than indices; IoError if it cannot be read.
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
  Colour colour{};  ///< of coloured pictures
  std::int64_t pixels = 0;
};

/// Contents of a picture.
struct PictureSurvey {
  PictureKind kind = PictureKind::grey8;
  int width_px = 0;
  int height_px = 0;
  std::vector<PictureUse> uses;         ///< most pixels first, then by value
  std::int64_t transparent_pixels = 0;  ///< fully or partly transparent; not counted in `uses`
  std::int64_t other_pixels = 0;        ///< of further colours beyond the limit of `uses`
};

/// Limit of different numbers or colours in a survey.
inline constexpr std::size_t kMostPictureUses = 65536;

/// Surveys any picture of a kind that IndexPictures reads. DataError with the file if it is damaged, of another kind,
/// or claims more pixels than the limits or its length allow; IoError if it cannot be read.
[[nodiscard]] PictureSurvey survey_picture(const Path& file, const ReadLimits& limits = {});

}  // namespace thermal
