#pragma once

#include <string>
#include <vector>

#include "io/exr_header.h"

namespace thermal {

/// Information on the parts of an EXR file besides their channels.
struct ExrParts {
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

/// Whether the name of this channel in the file has no layer.
[[nodiscard]] bool has_bare_name(const ExrChannel& channel);

/// Full names of all channels.
[[nodiscard]] std::vector<std::string> full_names(const std::vector<ExrChannel>& channels);

}  // namespace thermal
