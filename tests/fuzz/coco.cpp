#include "io/label_files/coco.h"

#include "fuzz/label_demands.h"
#include "fuzz/targets.h"

void fuzz::coco(Bytes bytes) {
  const auto file = as_file(bytes, "labels.json");
  tolerate([&file] {
    thermal::LabelSet set = thermal::read_coco(file);
    demand_consistent(set);
    thermal::assign_size_classes(set);
  });
}
