#include "dataset/run/transaction.h"

#include <set>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"
#include "support/two_clips.h"

namespace transaction_test {

using namespace thermal;

namespace {

/// Makes the files of a clip without pictures, as ClipOutput does.
ClipRecord make(const DatasetTransaction& transaction, const std::string& id, int frames = 2) {
  const Path folder = transaction.unfinished(id);
  make_fresh_folder(folder);
  return two_clips::write(folder, id, frames);
}

struct Place {
  TestFolder folder;
  Layout layout{folder / "set"};

  /// One that has the whole folder.
  [[nodiscard]] DatasetTransaction whole() const {
    return {layout, two_clips::document(), two_clips::kIds, Json()};
  }
  /// One that has this clip alone.
  [[nodiscard]] DatasetTransaction only(std::size_t place) const {
    return {layout, two_clips::document(), two_clips::kIds, Json(), std::vector{two_clips::kIds[place]}};
  }
  [[nodiscard]] Json document() const { return read_json(layout.dataset_json()); }
  [[nodiscard]] std::string status(std::size_t place) const { return document()["clips"][place]["status"]; }
  [[nodiscard]] bool is_there(const std::string& id) const {
    return std::filesystem::exists(layout.clip(id));
  }
  [[nodiscard]] bool is_unfinished(const std::string& id) const {
    return std::filesystem::exists(layout.unfinished_clip(id));
  }
};

}  // namespace

TEST_CASE("A committed clip is in its place, and the closed dataset lists it") {
  const Place place;
  {
    DatasetTransaction transaction = place.whole();
    transaction.begin();
    transaction.commit(make(transaction, "a"));
    CHECK(place.is_there("a"));
    CHECK_FALSE(place.is_unfinished("a"));
    CHECK_FALSE(std::filesystem::exists(place.layout.annotations_json()));
    transaction.commit(make(transaction, "b"));
    CHECK(transaction.close().empty());
  }
  CHECK(place.document()["status"] == "complete");
  CHECK(place.document().contains("annotations_sha256"));
  CHECK(place.whole().index().recorded);
}

TEST_CASE("A clip made again replaces the one that is there") {
  const Place place;
  DatasetTransaction transaction = place.whole();
  transaction.begin();
  transaction.commit(make(transaction, "a", 2));
  transaction.commit(make(transaction, "a", 3));
  CHECK(transaction.close().empty());
  CHECK(place.document()["frames"] == 3);
  CHECK(read_clip_record(place.layout.clip("a") / "clip.json").frames == 3);
}

TEST_CASE("Nothing is left of a rejected clip but the reason, as one line of plain text") {
  const Place place;
  DatasetTransaction transaction = place.whole();
  transaction.begin();
  (void)make(transaction, "a");
  transaction.reject("a", "no\nlight");
  CHECK_FALSE(place.is_unfinished("a"));
  CHECK(transaction.close().empty());
  CHECK(place.document()["clips"][0] == Json{{"id", "a"}, {"status", "failed"}, {"reason", "no; light"}});
  CHECK(place.status(1) == "pending");
}

TEST_CASE("A fault leaves what was committed, recorded, and nothing incomplete") {
  const Place place;
  try {
    DatasetTransaction transaction = place.whole();
    transaction.begin();
    transaction.commit(make(transaction, "a"));
    (void)make(transaction, "b");
    throw Cancelled();
  } catch (const Cancelled&) {
  }
  CHECK(place.is_there("a"));
  CHECK_FALSE(place.is_unfinished("b"));
  CHECK(place.document().contains("annotations_sha256"));
  CHECK(place.whole().index().recorded);
}

TEST_CASE("A second fault does not hide the first") {
  const Place place;
  const auto run = [&place] {
    DatasetTransaction transaction = place.whole();
    transaction.begin();
    transaction.commit(make(transaction, "a"));
    std::filesystem::remove(place.layout.clip("a") / "labels.json");  // cannot be joined any more
    throw DataError("the first");
  };
  CHECK(message_of<DataError>(run) == "the first");
}

TEST_CASE("Before it begins, a transaction changes nothing") {
  const Place place;
  { const DatasetTransaction transaction = place.whole(); }
  CHECK_FALSE(place.layout.is_begun());
  make_folder(place.layout.unfinished_clip("a"));
  { const DatasetTransaction transaction = place.whole(); }
  CHECK(place.is_unfinished("a"));
}

TEST_CASE("What a killed run left is found or removed when the next one begins") {
  const Place place;
  {
    DatasetTransaction transaction = place.whole();
    transaction.begin();
    (void)make(transaction, "a");
    std::filesystem::rename(place.layout.unfinished_clip("a"), place.layout.clip("a"));  // and not recorded
    (void)make(transaction, "b");
    std::filesystem::copy(place.layout.root, place.folder / "killed",
                          std::filesystem::copy_options::recursive);
  }
  const Layout killed{place.folder / "killed"};
  DatasetTransaction next(killed, two_clips::document(), two_clips::kIds, Json());
  CHECK(next.index().finished.contains("a"));
  CHECK_FALSE(next.index().recorded);
  CHECK(std::filesystem::exists(killed.unfinished_clip("b")));
  next.begin();
  CHECK_FALSE(std::filesystem::exists(killed.unfinished_clip("b")));
  CHECK(next.close().empty());
  CHECK(read_json(killed.dataset_json())["clips"][0]["status"] == "done");
}

TEST_CASE("What a killed run left is removed when there is nothing to make, too") {
  const Place place;
  {
    DatasetTransaction transaction = place.whole();
    transaction.begin();
    for (const char* id : {"a", "b"}) transaction.commit(make(transaction, id));
    CHECK(transaction.close().empty());
  }
  make_folder(place.layout.unfinished_clip("a") / "ir8");
  make_folder(place.layout.clips() / "foreign.part");
  CHECK(place.only(1).close().empty());
  CHECK(place.is_unfinished("a"));  // of another run
  CHECK(place.whole().close().empty());
  CHECK_FALSE(place.is_unfinished("a"));
  CHECK(std::filesystem::exists(place.layout.clips() / "foreign.part"));
}

TEST_CASE("A scratch folder, which one run has, keeps nothing of any clip") {
  Place place;
  place.layout.scratch = place.folder / "scratch";
  make_folder(place.layout.root);
  for (const char* id : {"a", "b"}) make_folder(place.layout.unfinished_clip(id) / "ir8");
  for (const char* name : {"annotations.json.tmp", "annotations.json.spool", "foreign.json"})
    write_file(place.layout.scratch / name, {});
  CHECK(place.only(0).close().empty());
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(place.layout.scratch))
    names.insert(entry.path().filename().string());
  CHECK(names == std::set<std::string>{".lock", "foreign.json"});
}

TEST_CASE("Nothing is removed where a link leads") {
  const Place place;
  make_folder(place.folder / "elsewhere" / "a.part");
  make_folder(place.layout.root);
  std::filesystem::create_directory_symlink(place.folder / "elsewhere", place.layout.clips());
  CHECK(place.whole().close().empty());
  CHECK(std::filesystem::exists(place.folder / "elsewhere" / "a.part"));
}

TEST_CASE("Two runs have clips of one dataset at the same time, and each learns what the other made") {
  const Place place;
  DatasetTransaction one = place.only(0);
  DatasetTransaction other = place.only(1);
  one.begin();
  other.begin();
  (void)make(other, "b");
  one.commit(make(one, "a"));
  CHECK(place.is_unfinished("b"));  // not the first one's to remove
  CHECK(one.close().empty());
  CHECK(place.status(1) == "pending");
  other.commit(make(other, "b"));
  CHECK(other.close().empty());
  CHECK(place.document()["status"] == "complete");
  CHECK(read_json(place.layout.annotations_json())["videos"].size() == 2);
}

TEST_CASE("A folder, or a clip of it, belongs to one run") {
  const Place place;
  const DatasetTransaction one = place.only(0);
  CHECK_THROWS_AS(place.only(0), TryAgainError);
  CHECK_THROWS_AS(place.whole(), TryAgainError);
}

TEST_CASE("A link in place of the clips' folder is refused before anything is written") {
  const Place place;
  const TestFolder elsewhere;
  make_folder(place.layout.root);
  std::filesystem::create_directory_symlink(elsewhere.path(), place.layout.clips());
  DatasetTransaction transaction = place.whole();
  CHECK_THROWS_AS(transaction.begin(), IoError);
  CHECK_FALSE(place.layout.is_begun());
}

}  // namespace transaction_test
