#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/image.h"
#include "io/exr_channel.h"
#include "io/exr_scan.h"
#include "io/files.h"

namespace thermal {

/// A rectangle of pixels, with its corner relative to the picture's top left; it may lie outside.
struct ExrWindow {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;

  [[nodiscard]] bool operator==(const ExrWindow&) const = default;
};

/// Contents of an EXR file's headers.
struct ExrHeader {
  int width_px = 0;  ///< of the display window: the intended picture
  int height_px = 0;
  ExrWindow data_window;  ///< of the first part: pixels outside it are not in the file, or not in the picture
  std::string compression;  ///< of the first part
  std::vector<ExrChannel> channels;
  std::map<std::string, std::string> texts;  ///< string attributes of all parts; the first of each name

  /// Channel of an object index, material index or depth pass, in any known spelling (see io/exr_spellings.h);
  /// nullptr if there is none. An empty `layer` means the only layer that has one; DataError with their names if
  /// several have.
  [[nodiscard]] const ExrChannel* find_object_index(const std::string& layer) const;
  [[nodiscard]] const ExrChannel* find_material_index(const std::string& layer) const;
  [[nodiscard]] const ExrChannel* find_depth(const std::string& layer) const;
  /// Component "X", "Y" or "Z" of the normal pass; its channels may be named R, G or B.
  [[nodiscard]] const ExrChannel* find_normal(const std::string& layer, const std::string& component) const;
};

/// Reads no pixels. IoError with the file and the library's reason, or with the header that exceeds the limits.
[[nodiscard]] ExrHeader read_exr_header(const Path& file, const ExrLimits& limits = {});

/// Pixels of one channel, of any type; `outside` where the display window extends beyond the data window. IoError
/// with the file, the channel and the library's reason; DataError for a subsampled channel.
[[nodiscard]] Plane<float> read_exr_channel(const Path& file, const ExrHeader& header,
                                            const ExrChannel& channel, float outside = 0,
                                            const ExrLimits& limits = {});

/// Pixels of several channels, decoding each part of the file once. Bits of float channels are kept; numbers above
/// 2^24 of uint channels are rounded to float. The same faults.
[[nodiscard]] std::vector<Plane<float>> read_exr_channels(const Path& file, const ExrHeader& header,
                                                          const std::vector<const ExrChannel*>& channels,
                                                          float outside = 0, const ExrLimits& limits = {});

}  // namespace thermal
