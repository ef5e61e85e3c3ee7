#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "io/json/file.h"

namespace thermal {

/// Of a calibration's text.
inline constexpr std::size_t kMostCalibrationBytes = std::size_t{1} << 20;

/// The tree of a calibration's text: maps, lists, numbers and strings. Numbers do not depend on the locale; what is no
/// finite decimal number is a string, except .nan and .inf. At most 1 MiB and 4000 brackets, tags and keys; no control
/// characters; nothing in base64. It is one of
/// - JSON, if the first characters are { and ";
/// - OpenCV's XML, if the first is <: one <opencv_storage>, in it tags with at most a type_id that end in order, up to 16
///   deep; words, numbers and strings without < > & ", and comments;
/// - YAML: maps and lists, in lines or in [ ] and { }, up to 16 deep; words, numbers, strings in quotes; comments;
///   %YAML; one document; the tag !!opencv-matrix. Other tags, anchors, aliases, block texts and merged keys are refused
///   by name.
/// ConfigError "NAME:LINE: expected …" for anything else.
[[nodiscard]] Json calibration_tree(std::string_view text, const std::string& name);

}  // namespace thermal
