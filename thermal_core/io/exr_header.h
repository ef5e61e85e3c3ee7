#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/image.h"
#include "io/exr_scan.h"
#include "io/files.h"

namespace thermal {

/// One channel of an EXR file, its name taken apart: "Scene.IndexOB.X" is component X of pass IndexOB in
/// layer Scene. Where the file has several parts, a channel without layer is in that of its part's name;
/// where it has several views, its layer ends with the view's name ("Scene.left").
struct ExrChannel {
  int part = 0;
  std::string name;  ///< as the file has it; channels of different parts may share one
  std::string layer;
  std::string pass;
  std::string component;
  std::string type;         ///< "half", "float" or "uint"
  std::string compression;  ///< of its part

  /// Layer, pass and component, with dots between those that it has: no other channel of the file has the
  /// same.
  [[nodiscard]] std::string full_name() const;
};

/// A rectangle of pixels, its corner counted from the picture's top left one; it may lie outside.
struct ExrWindow {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;

  [[nodiscard]] bool operator==(const ExrWindow&) const = default;
};

/// What an EXR file's headers say.
struct ExrHeader {
  int width_px = 0;  ///< of the display window: the picture that is meant
  int height_px = 0;
  ExrWindow data_window;    ///< of the first part: pixels outside are not in the file, or not in the picture
  std::string compression;  ///< of the first part
  std::vector<ExrChannel> channels;
  std::map<std::string, std::string> texts;  ///< attributes of type string, of all parts; the first of a name

  /// Channel of an object index, material index or depth pass, by any spelling in use (see
  /// io/exr_spellings.h); nullptr if there is none. `layer` empty means the only layer that has one;
  /// DataError, naming them, if several have.
  [[nodiscard]] const ExrChannel* find_object_index(const std::string& layer) const;
  [[nodiscard]] const ExrChannel* find_material_index(const std::string& layer) const;
  [[nodiscard]] const ExrChannel* find_depth(const std::string& layer) const;
  /// Component "X", "Y" or "Z" of the normal pass, which may be called R, G or B.
  [[nodiscard]] const ExrChannel* find_normal(const std::string& layer, const std::string& component) const;
};

/// Reads no pixels. IoError naming the file and the library's reason, or what of the headers passes the
/// limits.
[[nodiscard]] ExrHeader read_exr_header(const Path& file, const ExrLimits& limits = {});

/// Pixels of one channel, whatever its type; `outside` where the display window reaches beyond the data
/// window. IoError naming the file, the channel and the library's reason; DataError for a subsampled channel.
[[nodiscard]] Plane<float> read_exr_channel(const Path& file, const ExrHeader& header,
                                            const ExrChannel& channel, float outside = 0,
                                            const ExrLimits& limits = {});

/// Pixels of several channels, decoding each part of the file once. Bits of float channels are kept as they
/// are; numbers above 2^24 of uint channels are rounded to floats. The same faults.
[[nodiscard]] std::vector<Plane<float>> read_exr_channels(const Path& file, const ExrHeader& header,
                                                          const std::vector<const ExrChannel*>& channels,
                                                          float outside = 0, const ExrLimits& limits = {});

}  // namespace thermal
