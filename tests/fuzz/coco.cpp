#include "io/label_files/coco.h"

#include "dataset/exports/segments.h"
#include "fuzz/label_demands.h"
#include "fuzz/targets.h"
#include "io/json/file.h"

namespace {

/// What exports make of polygons.
void use_polygons(const thermal::LabelSet& set, std::string_view text) {
  thermal::SegmentMaker segments(set, thermal::Segmentation::rle);
  (void)thermal::parse_json_elements(
      text, "labels.json", [&](const std::string& list, std::size_t, const thermal::Json& annotation) {
        if (list != "annotations" || annotation.value("bbox", thermal::Json()).is_null()) return;
        if (!annotation.value("segmentation", thermal::Json()).is_array()) return;
        tolerate([&] { (void)segments.segmentation_of(annotation); });
        tolerate([&] { (void)segments.outline_of(annotation); });
      });
}

}  // namespace

void fuzz::coco(Bytes bytes) {
  const auto file = as_file(bytes, "labels.json");
  tolerate([&] {
    thermal::LabelSet set = thermal::read_coco(file);
    demand_consistent(set);
    thermal::assign_size_classes(set);
    use_polygons(set, text_of(bytes));
  });
}
