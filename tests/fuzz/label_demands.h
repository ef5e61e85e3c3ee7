#pragma once

#include <cmath>

#include "fuzz/target.h"
#include "labels/label_set.h"

inline void demand_finite(const thermal::LabelBox& box) {
  demand(std::isfinite(box.x_px) && std::isfinite(box.y_px), "a box is at a finite place");
  demand(std::isfinite(box.width_px) && box.width_px >= 0, "a box has a finite width");
  demand(std::isfinite(box.height_px) && box.height_px >= 0, "a box has a finite height");
}

/// Assumptions of exports, reports and analyses.
inline void demand_consistent(const thermal::LabelSet& set) {
  for (const thermal::LabelImage& image : set.images)
    demand(image.video < set.videos.size(), "a picture's video is there");
  for (const thermal::Label& label : set.labels) {
    demand(label.image < set.images.size(), "a label's picture is there");
    demand(label.category < set.categories.size(), "a label's category is there");
    demand_finite(label.box);
  }
}
