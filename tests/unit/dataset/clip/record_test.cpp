#include "dataset/clip/record.h"

#include "base/error.h"
#include "dataset/dataset_file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace clip_record_test {

using namespace thermal;

TEST_CASE("A record survives writing and reading") {
  const ClipRecord record = {.clip = "a",
                             .season = "summer",
                             .seed = 4294967295,
                             .frames = 3,
                             .annotations = 5,
                             .frame_rate_hz = 7.5,
                             .pixels_sha256 = "abc",
                             .files = {{"ir8/000000.png", "def"}}};
  const TestFolder folder;
  const ClipRecord read = read_clip_record(folder.file("clip.json", to_text(to_json(record))));
  CHECK(to_json(read) == to_json(record));
  CHECK(read.seed == 4294967295);
}

TEST_CASE("An invalid record is a DataError with the file") {
  const TestFolder folder;
  const auto fault_of = [&folder](const std::string& content) {
    const Path file = folder.file("clip.json", content);
    return message_of<DataError>([&] { (void)read_clip_record(file); }).substr(file.string().size());
  };
  CHECK(fault_of("{}") == ": clip = nothing; expected one");
  CHECK(fault_of("[]") == " = []; expected an object");
  const Json record = to_json(ClipRecord{.clip = "a", .season = "winter", .pixels_sha256 = "0", .files = {}});
  const auto with = [&](const char* key, const Json& value) {
    Json changed = record;
    changed[key] = value;
    return fault_of(to_text(changed));
  };
  CHECK(with("version", 999) == ": version = 999; expected 1, the version that this program reads");
  CHECK(with("frames", 1e308) == ": frames = 1e+308; expected a whole number");
  CHECK(with("annotations", -1) == ": annotations = -1; expected a whole number from 0 to 1000000000");
  CHECK(with("seed", 4294967296) == ": seed = 4294967296; expected a whole number from 0 to 4294967295");
  CHECK(with("frame_rate_hz", "9") == ": frame_rate_hz = \"9\"; expected a finite number");
  CHECK(with("skipped", Json::array({7})) == ": skipped[0] = 7; expected an object");
  CHECK_THAT(with("files", 7), StartsWith(": not a clip record: "));
  const Path cut = folder.file("cut.json", "{\"clip\": \"a\"");
  CHECK_THAT(message_of<DataError>([&] { (void)read_clip_record(cut); }),
             StartsWith(cut.string() + ":1:13: not JSON"));
}

TEST_CASE("A record names only files that a clip has, so that no other file is read, linked or replaced") {
  const TestFolder folder;
  const auto fault_of = [&folder](const std::string& clip, const std::string& name) {
    ClipRecord record{.clip = clip, .season = "winter", .pixels_sha256 = "0", .files = {{name, "0"}}};
    const Path file = folder.file("clip.json", to_text(to_json(record)));
    return message_of<DataError>([&] { (void)read_clip_record(file); }).substr(file.string().size());
  };
  const std::string rule =
      "; expected frames.jsonl, labels.json, preview.mp4, ir8/NNNNNN.png and ir16/NNNNNN.png only";
  for (const std::string name :
       {"../../../.bashrc", "/etc/passwd", "ir8/../../x.png", "ir8/00000.png", "ir8/-00001.png", "clip.json",
        "ir8/000000.png.part", "", "ir8/000000.PNG", "ir8/.png"}) {
    CHECK(fault_of("a", name) == ": files = " + brief(name) + rule);
  }
  CHECK_THAT(fault_of("../a", "labels.json"),
             StartsWith(": clip = \"../a\"; expected a name of at most 200 bytes"));
  const Path good = folder.file("good.json", to_text(to_json(ClipRecord{.clip = "a",
                                                                        .season = "winter",
                                                                        .pixels_sha256 = "0",
                                                                        .files = {{"ir8/1234567.png", "0"},
                                                                                  {"ir16/000000.png", "0"},
                                                                                  {"labels.json", "0"},
                                                                                  {"frames.jsonl", "0"},
                                                                                  {"preview.mp4", "0"}}})));
  CHECK(read_clip_record(good).files.size() == 5);
}

TEST_CASE("Frames are numbered with six digits") {
  CHECK(frame_name(0) == "000000.png");
  CHECK(frame_name(12) == "000012.png");
  CHECK(frame_name(1234567) == "1234567.png");
}

}  // namespace clip_record_test
