#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/json_file.h"
#include "labels/instances.h"
#include "labels/label_parameters.h"
#include "scene/lens_distortion.h"
#include "scene/manifest.h"

namespace thermal {

/// Collects one clip's labels, frame after frame, as a COCO document of its own: ids from 1, file names
/// relative to the clip's folder, one entry in videos.
class ClipAnnotations {
 public:
  /// `lens`: the distortion the labels went through; it is told with the camera, so that users can project.
  explicit ClipAnnotations(const Manifest& manifest, const LensDistortion& lens = {},
                           const LabelParameters& parameters = {});

  /// What is not known of an instance is left out. Places are rounded to 0.01 px, all else to four decimals.
  /// `frozen`: the shutter was closed, and the picture is one of before; what is labelled is where things are now.
  void add_frame(int frame, const std::vector<Instance>& instances, bool frozen = false);

  [[nodiscard]] int count() const noexcept { return static_cast<int>(annotations_.size()); }

  /// The document. Size classes are by the mean box area of a track over the clip (size_class_of()).
  [[nodiscard]] Json document() const;

 private:
  [[nodiscard]] Json annotation_of(const Instance& instance, int image_id, bool frozen) const;

  const Manifest& manifest_;
  LensDistortion lens_;
  LabelParameters parameters_;
  std::vector<const ManifestObject*> objects_;  ///< by index; null where it is no actor
  std::set<std::string> categories_;
  std::map<std::string, int> category_ids_;
  Json images_ = Json::array();
  Json annotations_ = Json::array();
};

/// Joins clips' documents into the dataset's: ids run on, file names become relative to the dataset's folder,
/// a category keeps its id. `clips` are their ids, in the same order.
[[nodiscard]] Json join_annotations(const std::string& dataset, const std::vector<std::string>& clips,
                                    const std::vector<Json>& documents);

}  // namespace thermal
