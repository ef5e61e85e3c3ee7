#include "base/error.h"
#include "dataset/run/monitor.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace room_test {

using namespace thermal;

namespace {

DatasetSpec small_pictures(int supersample) {
  DatasetSpec spec;
  spec.width_px = 100;
  spec.height_px = 50;
  spec.overscan_px = 5;
  spec.supersample = supersample;
  return spec;
}

std::string fault_of(std::int64_t left_bytes, std::int64_t needed_bytes) {
  return message_of<TryAgainError>([&] { check_space(left_bytes, needed_bytes, "out", "clip down"); });
}

}  // namespace

TEST_CASE("Before the first frame a clip needs the worst case: 40 bytes per pixel of passes, 4 of pictures") {
  const ClipSpec clip = {.id = "down", .frames = 10};
  CHECK(space_for(small_pictures(1), clip, {}).needed_bytes() == 10 * (40 * 110 * 60 + 4 * 100 * 50));
  CHECK(space_for(small_pictures(3), clip, {}).needed_bytes() == 10 * (40 * 330 * 180 + 4 * 100 * 50));
  CHECK(space_for(small_pictures(1), clip, {.pictures = false}).needed_bytes() == 10 * 40 * 110 * 60);
}

TEST_CASE("Existing files predict the size of the others") {
  ClipSpace space = {.frames = 10, .passes = {.worst_bytes = 1000}, .pictures = {.worst_bytes = 500}};
  CHECK(space.needed_bytes() == 15000);
  space.passes.add(100);
  CHECK(space.needed_bytes() == 9 * 100 + 10 * 500);
  space.passes.add(201);  // a mean of 150.5
  space.pictures.add(10);
  CHECK(space.needed_bytes() == 8 * 151 + 9 * 10);
  for (int frame = 2; frame < 10; ++frame) space.passes.add(150);
  for (int frame = 1; frame < 10; ++frame) space.pictures.add(10);
  CHECK(space.needed_bytes() == 0);
}

TEST_CASE("A clip of a terabyte does not overflow") {
  const ClipSpace space = {.frames = 1'000'000, .passes = {.worst_bytes = 40'000'000}, .pictures = {}};
  CHECK(space.needed_bytes() == 40'000'000'000'000);
}

TEST_CASE("Twice the needed space is enough, and less is not") {
  CHECK_NOTHROW(check_space(170'000'000, 85'000'000, "out", "clip down"));
  CHECK_NOTHROW(check_space(0, 0, "out", "clip down"));
  CHECK(fault_of(120'000'000, 85'000'000) ==
        "out = 120 MB left; expected at least 2 x the 85 MB that clip down still needs");
  CHECK(fault_of(169'999'999, 85'000'000).starts_with("out = 170 MB left"));
}

TEST_CASE("Bytes are printed in units of a thousand, with two digits or more") {
  CHECK(bytes_in_words(0) == "0 kB");
  CHECK(bytes_in_words(1499) == "1 kB");
  CHECK(bytes_in_words(999'000) == "999 kB");
  CHECK(bytes_in_words(999'600) == "1.0 MB");
  CHECK(bytes_in_words(1'249'000) == "1.2 MB");
  CHECK(bytes_in_words(9'960'000) == "10 MB");
  CHECK(bytes_in_words(85'400'000) == "85 MB");
  CHECK(bytes_in_words(1'200'000'000) == "1.2 GB");
  CHECK(bytes_in_words(5'000'000'000'000'000) == "5000 TB");
}

}  // namespace room_test
