#pragma once

#include <string>
#include <vector>

#include "io/files.h"
#include "scene/passes.h"

namespace thermal {

/// One channel of an EXR file, its name taken apart: "Scene.IndexOB.X" is component X of pass IndexOB in layer
/// Scene.
struct ExrChannel {
  int part = 0;
  std::string name;
  std::string layer;
  std::string pass;
  std::string component;
  std::string type;  ///< "half", "float" or "uint"
};

/// What an EXR file's headers say.
struct ExrHeader {
  int width_px = 0;
  int height_px = 0;
  std::string compression;
  std::vector<ExrChannel> channels;

  /// Channel of an object index, material index or depth pass, by any spelling in use; nullptr if there is
  /// none. `layer` empty means the only layer that has one; DataError, naming them, if several have.
  [[nodiscard]] const ExrChannel* find_object_index(const std::string& layer) const;
  [[nodiscard]] const ExrChannel* find_material_index(const std::string& layer) const;
  [[nodiscard]] const ExrChannel* find_depth(const std::string& layer) const;
  /// Component "X", "Y" or "Z" of the normal pass.
  [[nodiscard]] const ExrChannel* find_normal(const std::string& layer, const std::string& component) const;
};

/// Reads no pixels. IoError naming the file and the library's reason.
[[nodiscard]] ExrHeader read_exr_header(const Path& file);

/// Pixels of one channel, whatever its type. IoError naming the file, the channel and the library's reason.
[[nodiscard]] Plane<float> read_exr_channel(const Path& file, const ExrHeader& header,
                                            const ExrChannel& channel);

/// The planes of one frame that are needed, and no others. The size, unless 0, must be this one: checked before any memory is taken.
/// `actor_layer` is looked at if actors are needed: a file with no other object index than `layer`'s is one of a frame
/// without actor layer, whose plane stays empty.
/// DataError naming file, channel and pixel if there is no object index or a needed plane is missing, or an index is negative, fractional,
/// NaN or above 32767; IoError if the file cannot be read.
[[nodiscard]] Passes read_passes(const Path& file, const std::string& layer, int width_px, int height_px,
                                 const PassNeeds& needs = {}, const std::string& actor_layer = "");

}  // namespace thermal
