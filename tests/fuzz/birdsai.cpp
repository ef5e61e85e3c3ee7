#include "io/label_files/birdsai.h"

#include "fuzz/label_demands.h"
#include "fuzz/targets.h"

void fuzz::birdsai(Bytes bytes) {
  static const TestFolder folder;
  std::filesystem::create_directory(folder / "annotations");
  (void)folder.file("annotations/video.csv", text_of(bytes));
  tolerate([] { demand_consistent(thermal::read_birdsai(folder.path())); });
}
