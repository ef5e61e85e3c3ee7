#include "base/error.h"
#include "io/label_files/coco.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace coco_head_test {

using namespace thermal;

namespace {

const char* const kHead =
    R"({"info": {}, "categories": [{"id": 7, "name": "human"}, {"id": 2, "name": "lion"}],
 "videos": [{"id": 3, "name": "night"}])";

std::string fault_in(const std::string& text) {
  const TestFolder folder;
  const Path file = folder.file("truth.json", text);
  const std::string message = message_of<DataError>([&] { (void)read_coco_head(file); });
  return message.starts_with(file.string()) ? message.substr(file.string().size()) : message;
}

}  // namespace

TEST_CASE("Categories and videos are read, and nothing behind the images") {
  const TestFolder folder;
  const CocoHead head =
      read_coco_head(folder.file("truth.json", std::string(kHead) + R"(, "images": [{"id": 1}, no JSON)"));
  CHECK(head.categories == std::vector<std::pair<std::string, std::int64_t>>{{"human", 7}, {"lion", 2}});
  CHECK(head.videos == std::vector<std::string>{"night"});
  CHECK(read_coco_head(folder.file("whole.json", std::string(kHead) + "}")).videos == head.videos);
}

TEST_CASE("What is no such file is refused") {
  CHECK(fault_in("{").starts_with(":1:2: not JSON: "));
  CHECK(fault_in("[1, 2]") == ": [0] = 1; expected an object");
  CHECK(fault_in(R"({"images": []})") ==
        ": no list \"categories\" before its images; expected a COCO file of Veldt's");
  CHECK(fault_in(R"({"categories": [{"id": 1}]})") == ": categories[0].name = nothing; expected one");
  CHECK(fault_in(R"({"categories": [{"id": 1.5, "name": "a"}]})") ==
        ": categories[0].id = 1.5; expected a whole number");
  CHECK(fault_in(std::string(100, '['))
            .ends_with("lists and objects are nested more than 64 deep; expected fewer"));
}

TEST_CASE("Links are not followed") {
  const TestFolder folder;
  const Path file = folder.file("truth.json", std::string(kHead) + "}");
  std::filesystem::create_symlink(file, folder.path() / "link.json");
  CHECK_THAT(message_of<IoError>([&] { (void)read_coco_head(folder.path() / "link.json"); }),
             ContainsSubstring("link"));
  CHECK_THAT(message_of<IoError>([&] { (void)read_coco_head(folder.path()); }), ContainsSubstring("folder"));
}

}  // namespace coco_head_test
