#include "dataset/label_source.h"

#include <fmt/format.h>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace label_source_test {

using namespace thermal;

namespace {

const char* const kLabels = R"({"categories": [{"id": 1, "name": "human"}],
  "images": [{"id": 1, "file_name": "clips/a/ir8/000000.png", "width": 9, "height": 9}],
  "annotations": [{"id": 1, "image_id": 1, "category_id": 1, "bbox": [0, 0, 9, 9]}]})";

/// A dataset of two clips; `rest` goes into its record.
void write_dataset(const TestFolder& folder, const std::string& status_of_b, const std::string& rest) {
  (void)folder.file("annotations.json", kLabels);
  (void)folder.file("dataset.json", fmt::format(R"({{"format": "veldt-dataset", "veldt_version": "1", {}
      "config": {{"name": "savanna", "seed": 1, "sensor": {{"kelvin_per_count": 0.01}}}},
      "clips": [{{"id": "a", "status": "done", "record_sha256": "0", "frames": 1}},
                {{"id": "b", "status": "{}", "record_sha256": "0", "frames": 1}}]}})",
                                                rest, status_of_b));
}

std::string fault_of(const Path& source, bool unfinished_too = false) {
  const std::string message = message_of<Error>([&] { (void)read_labels(source, unfinished_too); });
  return message.starts_with(source.string()) ? message.substr(source.string().size()) : message;
}

const std::string kSummed = R"("annotations_sha256": "0", )";

}  // namespace

TEST_CASE("A finished dataset's labels have its name and size classes") {
  const TestFolder folder;
  write_dataset(folder, "done", kSummed);
  const LabelSet set = read_labels(folder.path());
  CHECK(set.name == "savanna");
  CHECK(set.root == folder.path().string());
  REQUIRE(set.labels.size() == 1);
  CHECK(set.labels[0].size == SizeClass::small);
}

TEST_CASE("A dataset with missing clips is refused, or read as it is") {
  const TestFolder folder;
  write_dataset(folder, "pending", kSummed);
  CHECK(fault_of(folder.path()) ==
        " is unfinished: 1 of 2 clips are missing: b; expected all of them, or --unfinished to accept this");
  CHECK(read_labels(folder.path(), true).labels.size() == 1);
}

TEST_CASE("A dataset whose labels are not joined yet is refused") {
  const TestFolder folder;
  write_dataset(folder, "done", "");
  for (const bool unfinished_too : {false, true}) {
    CHECK(fault_of(folder.path(), unfinished_too) ==
          ": annotations.json may lack clips (a run has not ended, or was killed); expected a finished run: "
          "run the same command again");
  }
}

TEST_CASE("A COCO file and a BIRDSAI folder are labels, too") {
  const TestFolder folder;
  CHECK(read_labels(folder.file("val.json", kLabels)).name == "val");
  std::filesystem::create_directories(folder / "real/annotations");
  (void)folder.file("real/annotations/v.csv", "0,1,0,0,50,50,0,1,0,0\n");
  const LabelSet set = read_labels(folder / "real");
  CHECK(set.name == "real");
  CHECK(set.labels.at(0).size == SizeClass::large);
}

TEST_CASE("A source without labels is reported") {
  const TestFolder folder;
  CHECK(
      fault_of(folder.path()) ==
      " holds no labels; expected a Veldt dataset (dataset.json), a BIRDSAI folder (annotations/*.csv) or a "
      "COCO file (.json)");
  CHECK(fault_of(folder / "nothing") == " does not exist");
  (void)folder.file("dataset.json", "{}");
  CHECK(fault_of(folder.path()) == "/dataset.json does not belong to a Veldt dataset");
  (void)folder.file("dataset.json", R"({"format": "veldt-dataset"})");
  CHECK(fault_of(folder.path()) == "/dataset.json: clips = missing; expected a list");
  (void)folder.file("dataset.json", R"({"format": "veldt-dataset", "veldt_version": "1", "clips": [],
      "config": {"name": "n", "seed": 1, "sensor": {"kelvin_per_count": 0.01}}})");
  CHECK_THAT(fault_of(folder.path()), StartsWith(": annotations.json may lack clips"));
  (void)folder.file("dataset.json", "{");
  CHECK_THAT(fault_of(folder.path()), StartsWith("/dataset.json:1:2: not JSON: "));
}

}  // namespace label_source_test
