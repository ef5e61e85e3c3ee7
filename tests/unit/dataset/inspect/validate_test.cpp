#include "dataset/inspect/validate.h"

#include <fstream>

#include "base/error.h"
#include "dataset/run/convert.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"
#include "support/tiny_clip.h"

namespace validate_test {

using namespace thermal;

namespace {

using Faults = std::vector<std::string>;

/// A dataset of two clips on disk.
struct Dataset {
  Dataset() {
    ConvertOptions options{.assets = kAssets};
    options.passes = {tiny_clip::write(folder / "passes", "a"), tiny_clip::write(folder / "passes", "b")};
    options.out = root;
    REQUIRE(convert(options, {}).front().run.complete);
  }
  [[nodiscard]] Faults faults() const { return validate_dataset(root).faults; }

  TestFolder folder;
  Path root = folder / "dataset";
};

void flip_byte(const Path& file, std::streamoff at) {
  std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekg(at);
  const int byte = bytes.get();
  bytes.seekp(at);
  bytes.put(static_cast<char>(byte ^ 1));
}

void append(const Path& file, const std::string& text) { std::ofstream(file, std::ios::app) << text; }

}  // namespace

TEST_CASE("A complete dataset has no faults, and every file is checked") {
  const Dataset dataset;
  const DatasetCheck check = validate_dataset(dataset.root);
  CHECK(check.faults.empty());
  CHECK(check.clips == 2);
  // A clip has 3 frames twice, labels.json, frames.jsonl, preview.mp4 and clip.json; and annotations.json.
  CHECK(check.files == 2 * (6 + 4) + 1);
}

TEST_CASE("The fault of a file is reported with its name") {
  const Dataset dataset;
  const Path clip = dataset.root / "clips" / "b";
  SECTION("a frame is missing") {
    std::filesystem::remove(clip / "ir8/000001.png");
    CHECK(dataset.faults() == Faults{(clip / "ir8/000001.png").string() + ": missing"});
  }
  SECTION("a byte of a frame has flipped, the first or any after it") {
    const Path frame = clip / "ir16/000002.png";
    const auto bytes = static_cast<std::streamoff>(std::filesystem::file_size(frame));
    for (const std::streamoff at : {std::streamoff{0}, bytes / 2, bytes - 1}) {
      flip_byte(frame, at);
      CHECK(dataset.faults() == Faults{frame.string() + ": changed since it was written"});
      flip_byte(frame, at);
      CHECK(dataset.faults().empty());
    }
  }
  SECTION("a frame was replaced by another") {
    std::filesystem::copy_file(clip / "ir8/000000.png", clip / "ir8/000002.png",
                               std::filesystem::copy_options::overwrite_existing);
    CHECK(dataset.faults() == Faults{(clip / "ir8/000002.png").string() + ": changed since it was written"});
  }
  SECTION("a frame is no longer a picture") {
    std::filesystem::resize_file(clip / "ir8/000000.png", 5);
    CHECK(dataset.faults() == Faults{(clip / "ir8/000000.png").string() + ": changed since it was written"});
  }
  SECTION("the annotations are cut short") {
    const Path annotations = dataset.root / "annotations.json";
    std::filesystem::resize_file(annotations, std::filesystem::file_size(annotations) / 2);
    CHECK(dataset.faults().size() == 1);
    CHECK_THAT(dataset.faults().at(0),
               StartsWith(annotations.string() + ":1:") && ContainsSubstring(": not JSON: syntax error"));
  }
  SECTION("the preview and the frames' records have changed") {
    append(clip / "preview.mp4", "x");
    append(clip / "frames.jsonl", "{}\n");
    CHECK(dataset.faults() == Faults{(clip / "frames.jsonl").string() + ": changed since it was written",
                                     (clip / "preview.mp4").string() + ": changed since it was written"});
  }
  SECTION("a clip's record is missing") {
    std::filesystem::remove(clip / "clip.json");
    CHECK(dataset.faults() == Faults{(clip / "clip.json").string() + ": missing"});
  }
}

TEST_CASE("Annotations of an unfinished run are named") {
  const Dataset dataset;
  Json index = read_json(dataset.root / "dataset.json");
  index.erase("annotations_sha256");
  write_file_atomically(dataset.root / "dataset.json", to_text(index));
  CHECK(dataset.faults() == Faults{(dataset.root / "annotations.json").string() +
                                   ": may lack clips (a run has not ended, or was killed)"});
}

TEST_CASE("A folder without a dataset cannot be checked") {
  const TestFolder folder;
  CHECK(message_of<IoError>([&] { (void)validate_dataset(folder.path()); }) ==
        "cannot read " + (folder / "dataset.json").string() + ": No such file or directory");
  const Path other = folder.file("dataset.json", "{}");
  CHECK(message_of<DataError>([&] { (void)validate_dataset(folder.path()); }) ==
        other.string() + " does not belong to a Veldt dataset");
}

}  // namespace validate_test
