#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/json_stream.h"
#include "io/spool.h"
#include "labels/instances.h"
#include "labels/label_parameters.h"
#include "scene/lens_distortion.h"
#include "scene/manifest.h"

namespace thermal {

/// Collects one clip's labels, frame after frame, as a COCO document of its own: ids from 1, file names
/// relative to the clip's folder, one entry in videos. What grows with the clip is put aside.
class ClipAnnotations {
 public:
  /// `lens`: the distortion the labels went through; it is told with the camera, so that users can project.
  /// `spool`: file that holds labels while the clip is made; empty: they stay in memory.
  explicit ClipAnnotations(const Manifest& manifest, const LensDistortion& lens = {},
                           const LabelParameters& parameters = {}, const Path& spool = {});

  /// What is not known of an instance is left out. Places are rounded to 0.01 px, all else to four decimals.
  /// `frozen`: the shutter was closed, and the picture is one of before; what is labelled is where things are now.
  void add_frame(int frame, const std::vector<Instance>& instances, bool frozen = false);

  [[nodiscard]] int count() const noexcept { return count_; }

  /// Writes the document, indented, at the end. Size classes are by the mean box area of a track over the clip
  /// (size_class_of()).
  void write(const TakeText& take);

 private:
  /// A frame that was made.
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
  std::vector<const ManifestObject*> objects_;  ///< by index; null where it is no actor
  std::set<std::string> categories_;
  std::map<std::string, int> category_ids_;
  std::vector<Image> images_;
  std::map<int, Boxes> tracks_;
  Spool annotations_;  ///< of each its text, then its track's id in a line of its own
  int count_ = 0;
};

/// The list of categories in use, by their ids.
[[nodiscard]] Json category_list(const std::set<std::string>& used);

}  // namespace thermal
