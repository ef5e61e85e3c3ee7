#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/exr_channel.h"

namespace thermal {

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

}  // namespace thermal
