#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/exr/header.h"
#include "io/exr/header_check.h"
#include "scene/manifest.h"
#include "scene/passes.h"

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

struct ExrTarget;

/// Finds the channels of a clip's planes in a file. Planes are searched in the layer of the object index; if that
/// layer has no name, or lacks them, in the only other layer without an object index. All faults are DataErrors
/// without the file's name.
class ExrPlanes {
 public:
  /// DataError if there is no object index, or several and none is chosen. Keeps references.
  ExrPlanes(const ExrHeader& header, const ExrLayout& layout);

  [[nodiscard]] const ExrChannel& objects() const noexcept { return *objects_; }
  [[nodiscard]] const ExrChannel* materials() const;  ///< null if there is none
  [[nodiscard]] const ExrChannel* depth() const;
  [[nodiscard]] const ExrChannel* normal(std::string_view axis) const;  ///< "X", "Y" or "Z"
  /// Null for a frame without that layer. DataError if the frame has a different one instead, probably misspelt.
  [[nodiscard]] const ExrChannel* actors() const;

  [[nodiscard]] const ExrChannel* sampled() const;  ///< kSampledPass; null if there is none

  [[nodiscard]] const ExrChannel& required_depth()
      const;  ///< DataError with a list of the channels if there is none
  [[nodiscard]] const ExrChannel& required_normal(std::string_view axis) const;

 private:
  [[nodiscard]] bool is_object_index(const ExrChannel& channel) const;
  /// Object indices of a layer, or of all.
  [[nodiscard]] std::vector<const ExrChannel*> indices_in(const std::optional<std::string>& layer) const;
  /// Layers in which there is an object index, in the file's order.
  [[nodiscard]] std::vector<std::string> index_layers() const;
  [[nodiscard]] const ExrChannel& find_objects() const;
  [[nodiscard]] const ExrChannel* find_beside(PassKind kind, std::string_view axis = "") const;
  [[nodiscard]] const ExrChannel& required(const ExrChannel* channel, const std::string& plane) const;

  const ExrHeader& header_;
  const ExrLayout& layout_;
  const ExrChannel* named_objects_ = nullptr;  ///< by the layout
  const ExrChannel* objects_ = nullptr;
  std::string layer_;  ///< layer of the other planes
};

/// DataError (without the file's name) if the picture's size differs from the layout's, if that has one.
void check_size(const ExrHeader& header, const ExrLayout& layout);

/// DataError (without the file's name) if the picture is not a pinhole's, but an environment map, or if its pixels have another
/// shape than the layout's, if that has one. Files that state square pixels pass: many writers state nothing else.
void check_projection(const ExrHeader& header, const ExrLayout& layout);

/// Adds depth and normals to be decoded, if needed; planes that are not needed are emptied.
[[nodiscard]] std::vector<ExrTarget> shape_targets(const ExrPlanes& planes, const PassNeeds& needs,
                                                   Plane<float>& depth_m,
                                                   std::array<Plane<float>, 3>& normal);

/// Whether there are depth and normals; ignores actors.
[[nodiscard]] PassNeeds planes_beside(const ExrPlanes& planes);

}  // namespace thermal
