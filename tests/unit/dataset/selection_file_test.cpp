#include "dataset/selection_file.h"

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace selection_file_test {

using namespace thermal;

namespace {

Selection two_datasets() {
  Selection selection;
  selection.seed = 7;
  selection.classes = {{.name = "small_animal", .at_least = 1, .at_most = 9, .available = 20, .taken = 5}};
  selection.objective = 3;
  selection.bound = 2;
  selection.gap = 1.0 / 3;
  selection.datasets = {{.path = "sets/a",
                         .name = "a",
                         .videos = {{.name = "one", .frames = {0, 4, 5}}, {.name = "two", .frames = {}}}},
                        {.path = "sets/b", .name = "b", .videos = {{.name = "one", .frames = {2}}}}};
  return selection;
}

/// The error for this text, without the file's name.
std::string fault_of(const std::string& text) {
  const TestFolder folder;
  const Path file = folder.file("s.json", text);
  const std::string message = message_of<DataError>([&] { (void)read_selection(file); });
  const std::string name = file.string() + ":";
  return message.starts_with(name) ? message.substr(name.size()) : message;
}

std::string with_videos(const std::string& videos) {
  std::string text =
      R"({"format": "veldt-selection", "version": 1, "datasets": [{"path": "a", "name": "a", "videos": [)";
  return text.append(videos).append("]}]}");
}

}  // namespace

TEST_CASE("a selection is read as it was written") {
  const TestFolder folder;
  const Path file = folder.path() / "s.json";
  write_selection(file, two_datasets());
  const Selection read = read_selection(file);
  CHECK(read.seed == 7);
  REQUIRE(read.classes.size() == 1);
  CHECK(read.classes[0].name == "small_animal");
  CHECK(read.classes[0].at_least == 1);
  CHECK(read.classes[0].at_most == 9);
  CHECK(read.classes[0].available == 20);
  CHECK(read.classes[0].taken == 5);
  CHECK(read.objective == 3);
  CHECK(read.bound == 2);
  CHECK(read.gap == 1.0 / 3);
  REQUIRE(read.datasets.size() == 2);
  CHECK(read.datasets[0].path == "sets/a");
  CHECK(read.datasets[1].name == "b");
  REQUIRE(read.datasets[0].videos.size() == 2);
  CHECK(read.datasets[0].videos[0].name == "one");
  CHECK(read.datasets[0].videos[0].frames == std::vector<int>{0, 4, 5});
  CHECK(read.datasets[0].videos[1].frames.empty());
}

TEST_CASE("a selection written by hand needs only the frames") {
  const TestFolder folder;
  const Path file = folder.file("s.json", with_videos(R"({"name": "one", "frames": [1, 3]})"));
  const Selection read = read_selection(file);
  CHECK(read.classes.empty());
  CHECK(read.datasets[0].videos[0].frames == std::vector<int>{1, 3});
}

TEST_CASE("an invalid selection is reported") {
  CHECK(fault_of("{").starts_with("1:2: not JSON: "));
  CHECK(fault_of(R"({"format": "coco"})") == " format = \"coco\"; expected veldt-selection");
  CHECK(fault_of(R"({"format": "veldt-selection", "version": 2, "datasets": []})") ==
        " version = 2; expected 1");
  CHECK(fault_of(R"({"format": "veldt-selection", "version": 1})") ==
        " datasets is missing; expected a value");
  CHECK(fault_of(with_videos(R"({"name": "one", "frames": [1.5]})")) ==
        " datasets[0].videos[0].frames[0] = 1.5; expected a whole number");
  CHECK(fault_of(with_videos(R"({"name": "one", "frames": [-1]})")) ==
        " datasets[0].videos[0].frames[0] = -1; expected at least 0 and at most 2147483647");
  CHECK(fault_of(with_videos(R"({"name": "one", "frames": [1, 4, 4]})")) ==
        " datasets[0].videos[0].frames[2] = 4; expected more than 4, the frame before it");
  CHECK(fault_of(with_videos(R"({"name": "one", "frames": []}, {"name": "one", "frames": []})")) ==
        " datasets[0].videos[1].name = \"one\"; expected a name unique among the videos of the dataset");
  CHECK(fault_of(with_videos(R"({"name": "one", "frame": []})"))
            .starts_with(" datasets[0].videos[0].frame is not a known key; expected one of name, frames"));
}

TEST_CASE("a dataset finds its part by path, otherwise by name") {
  const TestFolder folder;
  Selection selection = two_datasets();
  const auto part_of = [&](const Path& path, const std::string& name) {
    return selection_for(selection, "s.json", path, name).path;
  };
  CHECK(part_of("sets/b", "whatever") == "sets/b");
  CHECK(part_of("./sets/../sets/b/", "whatever") == "sets/b");
  CHECK(part_of("elsewhere/b", "b") == "sets/b");
  const auto fault = [&](const Path& path, const std::string& name) {
    return message_of<DataError>([&] { (void)part_of(path, name); });
  };
  CHECK(fault("sets/c", "c") ==
        "s.json: no entry for sets/c; expected one of sets/a, sets/b; did you mean \"sets/a\"?");
  selection.datasets[0].name = selection.datasets[1].name;
  CHECK(fault("elsewhere/b", "b") == "s.json: no entry for elsewhere/b; expected one of sets/a, sets/b");
}

}  // namespace selection_file_test
