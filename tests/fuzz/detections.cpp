#include "io/label_files/detections.h"

#include <cmath>

#include "fuzz/label_demands.h"
#include "fuzz/targets.h"

namespace {

/// Two pictures of one video, one without a size, and two categories.
thermal::LabelSet small_truth() {
  thermal::LabelSet truth;
  truth.categories = {{1, "lion"}, {7, "elephant"}};
  truth.videos = {{.name = "video"}};
  truth.images = {{.id = 1, .file = "video/0.png", .width_px = 640, .height_px = 512},
                  {.id = 2, .file = "video/1.png", .frame_index = 1}};
  return truth;
}

/// The bytes as results of the first picture, or of all if they are JSON.
std::filesystem::path results_of(Bytes bytes) {
  static const TestFolder folder;
  const std::string_view text = text_of(bytes);
  if (text.starts_with('[') || text.starts_with('{')) return as_file(bytes, "results.json");
  (void)folder.file("video_0.txt", text);
  return folder.path();
}

}  // namespace

void fuzz::detections(Bytes bytes) {
  static const thermal::LabelSet kTruth = small_truth();
  const auto source = results_of(bytes);
  tolerate([&source] {
    for (const thermal::Detection& detection : thermal::read_detections(source, kTruth)) {
      demand(detection.image < kTruth.images.size(), "a detection's picture is there");
      demand(detection.category < kTruth.categories.size(), "a detection's category is there");
      demand(std::isfinite(detection.score), "a score is finite");
      demand_finite(detection.box);
    }
  });
}
