#include "dataset/clip_record.h"

#include "base/error.h"
#include "dataset/layout.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

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
  const TemporaryFolder folder;
  const ClipRecord read = read_clip_record(folder.file("clip.json", to_text(to_json(record))));
  CHECK(to_json(read) == to_json(record));
  CHECK(read.seed == 4294967295);
}

TEST_CASE("An invalid record is a DataError with the file") {
  const TemporaryFolder folder;
  const Path empty = folder.file("empty.json", "{}");
  CHECK_THAT(message_of<DataError>([&] { (void)read_clip_record(empty); }),
             StartsWith(empty.string() + ": not a clip record: "));
  const Path cut = folder.file("cut.json", "{\"clip\": \"a\"");
  CHECK_THAT(message_of<DataError>([&] { (void)read_clip_record(cut); }),
             StartsWith(cut.string() + ":1:13: not JSON"));
}

TEST_CASE("Frames are numbered with six digits") {
  CHECK(frame_name(0) == "000000.png");
  CHECK(frame_name(12) == "000012.png");
  CHECK(frame_name(1234567) == "1234567.png");
}
