#include "dataset/dataset_index.h"

#include "base/error.h"
#include "support/catch.h"
#include "support/test_folder.h"
#include "support/two_clips.h"

namespace dataset_index_test {

using namespace thermal;

namespace {

struct Place {
  TestFolder folder;
  Layout layout{folder.path()};

  /// Writes a complete clip of two frames into the folder.
  [[nodiscard]] ClipRecord finish(const std::string& id) const {
    make_folder(layout.clip(id));
    return two_clips::write(layout.clip(id), id);
  }

  [[nodiscard]] DatasetIndex open() const {
    return open_dataset(layout, two_clips::document(), two_clips::kIds);
  }
  [[nodiscard]] Json document() const { return read_json(layout.dataset_json()); }
  [[nodiscard]] std::size_t joined() const { return read_json(layout.annotations_json())["videos"].size(); }
};

}  // namespace

TEST_CASE("During a run, dataset.json lists each clip and has no checksum of the annotations") {
  const Place place;
  DatasetIndex index = place.open();
  CHECK_FALSE(index.recorded);
  index.add("a", place.finish("a"));
  write_progress(place.layout, index);
  CHECK(place.document()["status"] == "unfinished");
  CHECK(place.document()["frames"] == 2);
  CHECK(place.document()["clips"][0]["status"] == "done");
  CHECK(place.document()["clips"][1]["status"] == "pending");
  CHECK_FALSE(place.document().contains("annotations_sha256"));
  CHECK_FALSE(std::filesystem::exists(place.layout.annotations_json()));
}

TEST_CASE("A run that was killed before it joined the labels is detected, whatever annotations exist") {
  const Place place;
  DatasetIndex index = place.open();
  index.add("a", place.finish("a"));
  write_dataset(place.layout, index);
  CHECK(place.open().recorded);
  index.add("b", place.finish("b"));
  write_progress(place.layout, index);
  CHECK(place.joined() == 1);
  const DatasetIndex again = place.open();
  CHECK(again.complete());
  CHECK_FALSE(again.recorded);
  write_dataset(place.layout, again);
  CHECK(place.joined() == 2);
  CHECK(place.open().recorded);
}

TEST_CASE("At the end dataset.json is the same as after a single run") {
  const Place place;
  DatasetIndex index = place.open();
  index.add("a", place.finish("a"));
  index.add("b", place.finish("b"));
  write_dataset(place.layout, index);
  const Json once = place.document();
  write_dataset(place.layout, place.open());
  CHECK(place.document() == once);
  CHECK(once["status"] == "complete");
  CHECK(once["frames"] == 4);
  CHECK(once["annotations"] == 2);
}

TEST_CASE("Clips made or failed by other runs meanwhile are added, but none of this run's own") {
  const Place place;
  DatasetIndex index = place.open();
  write_progress(place.layout, index);
  DatasetIndex others = place.open();
  others.add("b", place.finish("b"));
  others.failed["a"] = "no light";
  write_progress(place.layout, others);
  catch_up(place.layout, {"a"}, index);
  CHECK(index.finished.contains("b"));
  CHECK(index.failed.empty());
  catch_up(place.layout, {}, index);
  CHECK(index.failed == std::map<std::string, std::string>{{"a", "no light"}});
  others.failed.clear();
  write_progress(place.layout, others);
  catch_up(place.layout, {}, index);
  CHECK(index.failed.empty());
}

TEST_CASE("A failed clip is listed until it is complete") {
  const Place place;
  DatasetIndex index = place.open();
  index.failed["a"] = "no light";
  write_progress(place.layout, index);
  CHECK(place.document()["clips"][0] == Json{{"id", "a"}, {"status", "failed"}, {"reason", "no light"}});
  CHECK(place.open().failed.contains("a"));
  (void)place.finish("a");
  CHECK(place.open().failed.empty());
}

}  // namespace dataset_index_test
