#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/json/file.h"
#include "io/system/temporary.h"
#include "labels/instances.h"
#include "scene/camera_model.h"
#include "scene/manifest.h"

namespace thermal {

/// Collects one clip's labels, frame after frame, as a COCO document of its own: ids from 1, file names relative to
/// the clip's folder, one entry in videos. Data that grows with the clip is spooled.
class ClipAnnotations {
 public:
  /// `lens`: the distortion applied to the labels; written with the camera, so that users can project points.
  /// `spool`: file for labels while the clip is made; empty: in memory.
  explicit ClipAnnotations(const Manifest& manifest, const LensDistortion& lens = {},
                           const LabelParameters& parameters = {}, const Path& spool = {});

  /// Adds label_entry() of each instance.
  /// `frozen`: the shutter was closed, and the picture is an earlier one; labels show the current positions.
  void add_frame(int frame, const std::vector<Instance>& instances, bool frozen = false);

  [[nodiscard]] int count() const noexcept { return count_; }

  /// Writes the document, indented, at the end. Size classes are by the mean box area of a track over the clip
  /// (size_class_of()).
  void write(const TakeText& take);

 private:
  /// A finished frame.
  struct Image {
    int frame = 0;
    bool frozen = false;
  };
  /// Boxes of one track.
  struct Boxes {
    double area_px = 0;
    int count = 0;
  };

  [[nodiscard]] Json annotation_of(const Instance& instance, int image_id, bool frozen) const;
  [[nodiscard]] Json head() const;
  [[nodiscard]] Json image_entry(const Image& image) const;
  void write_annotations(JsonStream& document);

  const Manifest& manifest_;
  LensDistortion lens_;
  LabelParameters parameters_;
  std::vector<const ManifestObject*> objects_;  ///< by index; null if it is not an actor
  std::set<std::string> categories_;
  std::map<std::string, int> category_ids_;
  std::vector<Image> images_;
  std::map<int, Boxes> tracks_;
  Spool annotations_;  ///< for each its text, then its track's id on a line of its own
  int count_ = 0;
};

/// An actor's annotation, without ids of its own, of its image and of its category. Unknown properties are left out.
/// Positions are rounded to 0.01 px, everything else to four decimals.
[[nodiscard]] Json label_entry(const Instance& instance, const ManifestObject& actor,
                               const CameraIntrinsics& camera, const LabelParameters& parameters,
                               bool frozen);

/// The list of categories in use, by id.
[[nodiscard]] Json category_list(const std::set<std::string>& used);

}  // namespace thermal
