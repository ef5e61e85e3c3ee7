#pragma once

#include <string>

#include "io/exr/scan.h"
#include "scene/manifest.h"

namespace thermal {

/// Location of the planes of a clip's EXR files.
struct ExrLayout {
  std::string layer = {};         ///< empty: the only one
  std::string actor_layer = {};   ///< empty: none
  std::string mirror_layer = {};  ///< empty: none
  PassChannels channels = {};     ///< those with unusual names
  int supersample = 1;            ///< samples along each side of a pixel of the camera
  int width_px = 0;               ///< 0: any size
  int height_px = 0;
  double pixel_aspect = 0;  ///< width of a pixel / its height; 0: any
  ExrLimits limits = {};
};

}  // namespace thermal
