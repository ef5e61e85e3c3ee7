#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/image/kelvin_picture.h"
#include "io/system/files.h"
#include "labels/box_style.h"
#include "labels/label_set.h"

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

/// Request for frames: the ir8 of a Veldt dataset, or a folder of grey pictures. In kelvin, the ir16 of a dataset, or a
/// folder of pictures that read_kelvin_picture() reads.
struct FrameRequest {
  Path source;
  Path labels = {};  ///< COCO file of a folder; empty: annotations.json in it or in its parent, if there
  std::string names = {};                ///< of a folder: pattern for FrameNames; empty: none
  std::string names_option = "--names";  ///< option in messages
  std::string category = {};             ///< of the boxes, in any case; empty: people
  BoxStyle boxes = BoxStyle::visible;    ///< of a dataset
  bool kelvin = false;                   ///< frames are temperatures: a dataset's ir16
  StoredScale scale = {};                ///< of a folder's pictures
};

/// A picture to measure, with its metadata.
struct SourceFrame {
  Path file;
  std::string name;
  std::size_t video = 0;             ///< clip; 0 in a folder
  std::optional<double> altitude_m;  ///< above ground
  std::vector<LabelBox> boxes;       ///< without crowds and ignored ones
};

/// Mapping of temperatures to levels: 0 is the coldest, 255 the warmest.
struct KelvinLevels {
  StoredScale stored;
  double lowest_k = 0;
  double kelvin_per_level = 1;
};

/// Frames in order, by clip and frame, or by name.
struct FrameSource {
  std::string name;
  bool is_dataset = false;
  std::vector<SourceFrame> frames;
  std::optional<KelvinLevels> kelvin = {};  ///< empty: frames are grey levels
  std::string no_boxes;                     ///< reason why there are no boxes; empty if there are
};

/// Whether a category is the requested one, in any case; people if the request names none.
[[nodiscard]] bool is_requested(const std::string& category, const std::string& requested);

/// Lists the frames of a source and reads its labels; opens no picture. ConfigError for labels, patterns of names and a
/// scale for a Veldt dataset, and for drawn boxes of a folder; DataError for a folder without pictures, a name that
/// does not match the pattern, labels without any of the frames or with an ambiguous one, and as read_labels() and
/// read_coco(); IoError if the source does not exist.
[[nodiscard]] FrameSource read_frame_source(const FrameRequest& request);

}  // namespace thermal
