#include "dataset/dataset_file.h"

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace dataset_file_test {

using namespace thermal;

namespace {

std::string fault_of(const std::string& content) {
  const TestFolder folder;
  const Path file = folder.file("dataset.json", content);
  return message_of<DataError>([&] { (void)read_dataset_file(folder.path()); }).substr(file.string().size());
}

std::string clips_fault(const std::string& clips) {
  return fault_of(R"({"format": "veldt-dataset", "clips": )" + clips + "}");
}

}  // namespace

TEST_CASE("A dataset's file is read as it is") {
  const TestFolder folder;
  (void)folder.file("dataset.json",
                    R"({"format": "veldt-dataset", "veldt_version": "1",
                        "config": {"name": "n", "seed": 1, "sensor": {"kelvin_per_count": 0.01}},
                        "clips": [{"id": "a", "status": "done", "record_sha256": "0", "frames": 3}]})");
  CHECK(read_dataset_file(folder.path()).at("clips").at(0).at("id") == "a");
}

TEST_CASE("A value that others rely on is named if it is missing or of another kind") {
  CHECK(clips_fault("[]") == ": veldt_version = nothing; expected text");
  CHECK(clips_fault(R"([], "veldt_version": "1", "config": {"name": 7})") ==
        ": config.name = 7; expected text");
  CHECK(clips_fault(R"([], "veldt_version": "1", "annotations_sha256": [], "config": {"name": "n", "seed": 1,
                        "sensor": {"kelvin_per_count": 0.01}})") ==
        ": annotations_sha256 = []; expected text");
  CHECK(clips_fault(R"([{"id": "a", "status": "done"}])") ==
        ": clips[0].record_sha256 = nothing; expected one");
  CHECK(clips_fault(R"([{"id": "a", "status": "pending", "frames": "9"}])") ==
        ": clips[0].frames = \"9\"; expected a whole number");
  CHECK(clips_fault(R"([{"id": "a", "status": "pending", "frames": null}])") ==
        ": clips[0].frames = null; expected a whole number");
  CHECK(clips_fault(R"([{"id": "a", "status": "pending", "record_sha256": 7}])") ==
        ": clips[0].record_sha256 = 7; expected a string");
  CHECK(clips_fault(R"([{"id": "a", "status": "failed"}])") == ": clips[0].reason = nothing; expected one");
}

TEST_CASE("Another version is refused by name") {
  CHECK(fault_of(R"({"format": "veldt-dataset", "version": 999, "clips": []})") ==
        ": version = 999; expected 1, the version that this program reads");
  CHECK(fault_of(R"({"format": "veldt-dataset", "version": "1", "clips": []})") ==
        ": version = \"1\"; expected 1, the version that this program reads");
}

TEST_CASE("Other files are refused") {
  for (const std::string content : {"{}", "[]", "7", R"({"format": "coco"})", R"({"format": 7})"})
    CHECK(fault_of(content) == " does not belong to a Veldt dataset");
  CHECK_THAT(fault_of("{"), StartsWith(":1:2: not JSON"));
  CHECK(fault_of(R"({"format": "veldt-dataset"})") == ": clips = missing; expected a list");
  CHECK(clips_fault("{}") == ": clips = {}; expected a list");
}

TEST_CASE("Ids of clips are names, each once, because they become names of folders") {
  const std::string rule =
      "; expected a name of at most 200 bytes without \"/\" or control characters that does not begin with "
      "\"-\"";
  CHECK(clips_fault(R"([{"id": "../../victim", "status": "done"}])") ==
        ": clips[0].id = \"../../victim\"" + rule);
  CHECK(clips_fault(R"([{"id": "/tmp/x", "status": "done"}])") == ": clips[0].id = \"/tmp/x\"" + rule);
  CHECK(clips_fault(R"([{"id": "-rf", "status": "done"}])") == ": clips[0].id = \"-rf\"" + rule);
  CHECK(clips_fault(R"([{"id": "a\u001b[2J", "status": "done"}])") ==
        ": clips[0].id = \"a\\u001b[2J\"" + rule);
  CHECK(clips_fault(R"([{"id": "a", "status": "pending"}, {"id": "a", "status": "pending"}])") ==
        ": clips[1].id = \"a\"; expected each id once");
  CHECK(clips_fault(R"([{"id": 7, "status": "done"}])") == ": clips[0].id = 7; expected a string");
  CHECK(clips_fault(R"([{"id": "a"}])") == ": clips[0].status = nothing; expected one");
  CHECK(clips_fault("[7]") == ": clips[0] = 7; expected an object");
  CHECK(clips_fault(R"([{"id": ")" + std::string(1000000, 'a') + R"(", "status": "done"}])") ==
        ": clips[0].id = \"" + std::string(59, 'a') + "…" + rule);
}

}  // namespace dataset_file_test
