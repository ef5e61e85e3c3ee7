#pragma once

#include <functional>
#include <map>
#include <string>

#include "io/image/picture_size.h"
#include "io/system/files.h"

namespace thermal {

/// EXIF and XMP tags of a photo.
struct PhotoTags {
  PictureSize size;
  /// By OpenImageIO's names, such as "Exif:FocalLength" or "drone-dji:RelativeAltitude": texts unchanged, numbers in
  /// their shortest form, several separated by blanks.
  std::map<std::string, std::string, std::less<>> texts;
};

/// Tags of a PNG, JPEG or TIFF of at most 256 MiB, without those that are longer than 256 bytes; no pixel is decoded.
/// DataError with the file if it is another kind, larger or damaged; IoError if it cannot be read. OpenImageIO finds
/// nothing in XMP whose rdf:Description has no end tag, which is legal; DJI and FLIR write end tags.
[[nodiscard]] PhotoTags read_photo_tags(const Path& file);

}  // namespace thermal
