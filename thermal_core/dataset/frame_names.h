#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace thermal {

/// Camera parameters in the name of a frame's file.
struct NamedPose {
  std::optional<double> altitude_m;
  std::optional<double> look_angle_deg;
};

/// A pattern of names of frames, without their extension, such as "{_}_{altitude_m}_{look_angle_deg}_{_}_{_}": fields
/// in braces, separated by text. A field matches one or more characters, up to the next text.
class FrameNames {
 public:
  /// ConfigError, beginning with `where`, for a field other than {altitude_m}, {look_angle_deg} and {_}, for one that
  /// follows another without text between them, and for a pattern without {altitude_m} and {look_angle_deg}.
  FrameNames(std::string_view pattern, const std::string& where);

  /// Empty for a name that does not match, or whose fields are not numbers.
  [[nodiscard]] std::optional<NamedPose> read(std::string_view name) const;

 private:
  struct Piece {
    std::string field;
    std::string text;  ///< after the field
  };
  std::string start_;
  std::vector<Piece> pieces_;
};

}  // namespace thermal
