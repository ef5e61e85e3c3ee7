#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace thermal {

/// Id in a label file of a picture, a label or a category: a whole number or text. 1 and "1" differ; numbers precede
/// texts.
using LabelId = std::variant<std::int64_t, std::string>;

/// For messages: 7, or "site1/0001" with quotes.
[[nodiscard]] std::string id_text(const LabelId& id);

/// A box in pixels: the top left corner of the top left pixel is (0, 0); sides may be fractional.
struct LabelBox {
  double x_px = 0;
  double y_px = 0;
  double width_px = 0;
  double height_px = 0;

  [[nodiscard]] double area_px() const noexcept { return width_px * height_px; }
  [[nodiscard]] bool operator==(const LabelBox&) const = default;
};

/// Size of a target in its video (Bondi et al. 2018); see assign_size_classes().
enum class SizeClass { small, medium, large };

/// Its name in files: "small", "medium" or "large".
[[nodiscard]] std::string size_class_name(SizeClass size) noexcept;

/// By the mean area of a track's boxes over its video: small below 200 px, large above 2000 px, else medium.
/// Source: Bondi et al., COMPASS 2018, section 5.
[[nodiscard]] SizeClass size_class_of(double mean_box_area_px) noexcept;

/// Whether the boxes of labels or detections are fractions of their pictures, as other formats have them: all within 0
/// and 1, and not all of whole numbers. False without boxes.
template <typename Boxed>
[[nodiscard]] bool are_fractions(const std::vector<Boxed>& boxed) {
  const auto sides = [](const LabelBox& box) {
    return std::array{box.x_px, box.y_px, box.x_px + box.width_px, box.y_px + box.height_px};
  };
  const auto is_within = [&sides](const Boxed& one) {
    return std::ranges::all_of(sides(one.box), [](double side) { return side >= 0 && side <= 1; });
  };
  const auto is_whole = [&sides](const Boxed& one) {
    return std::ranges::all_of(sides(one.box), [](double side) { return side == std::floor(side); });
  };
  return std::ranges::all_of(boxed, is_within) && !std::ranges::all_of(boxed, is_whole);
}

/// What labels call actors of one kind.
struct LabelCategory {
  LabelId id;
  std::string name;
};

/// A video: a clip of a dataset, or a sequence of BIRDSAI. Pictures without a video form a video of their own.
struct LabelVideo {
  std::string name;
  double frame_rate_hz = 0;  ///< 0: unknown
  bool in_time = true;       ///< false: the order of its pictures is unknown
};

/// A picture that has labels.
struct LabelImage {
  LabelId id;
  std::string file;  ///< relative to LabelSet::root, "/" between folders
  int width_px = 0;  ///< 0: unknown
  int height_px = 0;
  std::size_t video = 0;              ///< index into LabelSet::videos
  int frame_index = 0;                ///< in its video, from 0
  std::optional<double> time_s = {};  ///< not given by every source
};

/// One target in one picture. Optional members are not given by every source.
struct Label {
  LabelId id;
  std::size_t image = 0;     ///< index into LabelSet::images
  std::size_t category = 0;  ///< index into LabelSet::categories
  LabelBox box;
  double area_px = 0;  ///< of the mask if there is one, otherwise of the box
  bool crowd = false;
  bool ignore = false;     ///< ignored: neither a detection nor a miss counts
  bool noisy = false;      ///< the picture is frozen or corrupted
  bool truncated = false;  ///< extends beyond the picture
  SizeClass size = SizeClass::medium;
  std::optional<std::int64_t> track_id;  ///< unique within its video
  std::optional<bool> occluded;
  std::optional<double> visibility;  ///< fraction of its pixels that is not hidden, 0..1
  std::optional<double> truncated_fraction;
  std::optional<double> range_m;
  std::optional<double> temperature_k;   ///< apparent
  std::optional<double> contrast_k;      ///< apparent, minus the surroundings
  std::optional<double> contrast_noise;  ///< the same in standard deviations of a pixel's noise
};

/// Labels of pictures from any source: a Veldt dataset, BIRDSAI, any COCO file. Images are in the order of their
/// videos and frames; labels in the order of their images.
struct LabelSet {
  std::string name;
  std::string root;           ///< folder to which image file names are relative
  bool from_windows = false;  ///< the file has "\" between folders, which became "/"
  std::vector<LabelCategory> categories;
  std::vector<LabelVideo> videos;
  std::vector<LabelImage> images;
  std::vector<Label> labels;
};

/// Assigns size classes to all tracks, by size_class_of(). A label without a track is its own track.
void assign_size_classes(LabelSet& set);

/// A picture's name prefixed with its video's, without folders and extension, unique in the set: "winter_000012".
/// Exports for tools that expect all pictures in one folder use it as file name.
[[nodiscard]] std::string flat_name(const LabelSet& set, const LabelImage& image);

/// Whether a category is people or vehicles, with bicycles and motorbikes; all others are animals.
enum class Kind { animal, human, vehicle };
/// The kind of a category.
[[nodiscard]] Kind kind_of(const std::string& category) noexcept;

/// Ids of the categories a dataset may label. Known categories have the same id in every dataset, so that datasets
/// can be joined; others follow in alphabetical order. Ids start at 1.
[[nodiscard]] std::map<std::string, int> number_categories(const std::set<std::string>& used);

/// One detection by a detector in one picture.
struct Detection {
  std::size_t image = 0;     ///< index into LabelSet::images
  std::size_t category = 0;  ///< index into LabelSet::categories
  LabelBox box;              ///< width and height 0 or more; may extend beyond the picture
  double score = 0;          ///< confidence; any finite number, higher is more confident
};

}  // namespace thermal
