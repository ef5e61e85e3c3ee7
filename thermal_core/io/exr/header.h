#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "io/exr/header_check.h"
#include "io/system/files.h"

namespace thermal {

/// One channel of an EXR file, with its name parsed: "Scene.IndexOB.X" is component X of pass IndexOB in layer Scene.
/// In a file with several parts, a channel without a layer is in the layer of its part's name; with several views,
/// its layer ends with the view's name ("Scene.left").
struct ExrChannel {
  int part = 0;
  std::string name;  ///< as in the file; channels of different parts may share one
  std::string layer;
  std::string pass;
  std::string component;
  std::string type;         ///< "half", "float" or "uint"
  std::string compression;  ///< of its part

  /// Layer, pass and component, as far as present, joined by dots; unique in the file.
  [[nodiscard]] std::string full_name() const;
};

/// The content of a pass.
enum class PassKind { object_index, material_index, depth, normal };

/// Kind of a pass by its name, in the spellings in use, whatever their case and with or without spaces, "_" and "-":
/// | kind           | spelt                            | by |
/// | object index   | IndexOB, Object Index, Object ID | Blender to 4.x, 5.x; others |
/// | material index | IndexMA, Material Index, Material ID | the same |
/// | depth          | Depth, Z                         | Blender; the name that OpenEXR reserves |
/// | normal         | Normal, N                        | Blender; RenderMan's family |
/// Source: files that Blender 3.4.1 and 5.0.1 wrote; Technical Introduction to OpenEXR, "Channel names"; the
/// RenderMan Interface's name for the shading normal.
[[nodiscard]] std::optional<PassKind> pass_kind_of(std::string_view pass);

/// The text with capital letters; only ASCII changes.
[[nodiscard]] std::string upper_case(std::string_view text);

/// The channel that fits a pass best among these channels of one layer: by spelling, in the order above, then by
/// component: for normals the letter requested or the corresponding colour; for others X, V or R (Z for depth) before
/// any, alpha last. Null if none fits. `axis` is "X", "Y" or "Z" for normals, otherwise empty.
[[nodiscard]] const ExrChannel* best_of(const std::vector<const ExrChannel*>& channels, PassKind kind,
                                        std::string_view axis = "");

/// The one of these channels that is "X", "Y" or "Z" of a vector, or the corresponding colour; null if there is none.
[[nodiscard]] const ExrChannel* axis_of(const std::vector<const ExrChannel*>& channels,
                                        std::string_view axis);

/// best_of() for channels of all layers; DataError with the layers' names if several have one. `choice` is the
/// manifest key that selects one of them.
[[nodiscard]] const ExrChannel* only_best_of(const std::vector<const ExrChannel*>& channels, PassKind kind,
                                             std::string_view axis, std::string_view choice);

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
  Path folder;       ///< of the file, where other files that it names are
  int width_px = 0;  ///< of the display window: the intended picture
  int height_px = 0;
  ExrWindow data_window;  ///< of the first part: pixels outside it are not in the file, or not in the picture
  double pixel_aspect = 1;  ///< width of a pixel / its height
  std::string environment;  ///< of an environment map, what it is: "latlong" or "cube"; otherwise empty
  std::string compression;  ///< of the first part
  std::vector<ExrChannel> channels;
  std::map<std::string, std::string> texts;  ///< string attributes of all parts; the first of each name

  /// Channel of an object index, material index or depth pass, in any known spelling (see io/exr/header.h);
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

/// Information on the parts of an EXR file besides their channels.
struct ExrParts {
  /// A part of a multi-part file.
  struct Part {
    std::string name;
    std::string view;
  };
  std::vector<Part> parts;
  std::vector<std::string> views;  ///< of a file with several views in one part: its attribute multiView
};

/// Parses the names of all channels of a file: sets layer, pass and component of channels that have name and part.
/// - A component is one letter, or a colour's name as Nuke writes it; "Scene.Z" is the depth of layer Scene
///   if that has other passes or colours and no Scene.X.
/// - A channel without a layer is in the layer of its part's name, if there are several parts.
/// - Views are part of channels' names, as in Blender ("Scene.Depth.left.Z") or OpenEXR
///   ("Scene.left.Depth.Z"), or attributes of parts; several views make one layer each ("Scene.left").
/// Source: OpenEXR, Storing Multi-View Images in OpenEXR Files; files that Blender 3.4.1 and 5.0.1 wrote.
void name_channels(std::vector<ExrChannel>& channels, const ExrParts& file);

/// Red, green and blue of each picture in a file, such as Combined.R, .G and .B, or R, G and B; in the order of the reds.
[[nodiscard]] std::vector<std::array<const ExrChannel*, 3>> pictures_in(const ExrHeader& header);

/// Whether the name of this channel in the file has no layer.
[[nodiscard]] bool has_bare_name(const ExrChannel& channel);

/// Full names of all channels.
[[nodiscard]] std::vector<std::string> full_names(const std::vector<ExrChannel>& channels);

}  // namespace thermal
