#pragma once

#include <string>
#include <vector>

#include "io/exr_header.h"

namespace thermal {

/// What an EXR file says of its parts, beside their channels.
struct ExrParts {
  struct Part {
    std::string name;
    std::string view;
  };
  std::vector<Part> parts;
  std::vector<std::string> views;  ///< of a file that has several in one part: its attribute multiView
};

/// Takes the names of all channels of a file apart: sets layer, pass and component of channels that have name
/// and part.
/// - A component is one letter, or a colour's name as Nuke writes it; "Scene.Z" is the depth of layer Scene
///   where that has other passes or colours and no Scene.X.
/// - A channel without layer is in that of its part's name, if there are several parts.
/// - Views stand in channels' names as Blender has them ("Scene.Depth.left.Z") or OpenEXR
///   ("Scene.left.Depth.Z"), or are parts' attributes; several make a layer each ("Scene.left").
/// Source: OpenEXR, Storing Multi-View Images in OpenEXR Files; files that Blender 3.4.1 and 5.0.1 wrote.
void name_channels(std::vector<ExrChannel>& channels, const ExrParts& file);

/// Whether the file gave this channel no layer in its name.
[[nodiscard]] bool has_bare_name(const ExrChannel& channel);

/// Full names of all channels.
[[nodiscard]] std::vector<std::string> full_names(const std::vector<ExrChannel>& channels);

}  // namespace thermal
