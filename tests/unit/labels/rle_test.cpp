#include "labels/rle.h"

#include <limits>
#include <random>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace rle_test {

using namespace thermal;

namespace {

constexpr std::uint32_t kLargest = std::numeric_limits<std::uint32_t>::max();

/// Counts of any size: with a random number of bits, up to what a mask of any frame could need.
RunLengths random_counts(std::mt19937& random) {
  RunLengths counts(random() % 40);
  for (std::uint32_t& count : counts) count = static_cast<std::uint32_t>(random()) >> (random() % 32);
  return counts;
}

}  // namespace

// Made by the COCO API's own encoder: pycocotools 2.0, mask.encode.
TEST_CASE("Run lengths are written as the COCO API writes them") {
  CHECK(encode_coco_rle({20}) == "d0");                                   // 4 x 5 px, none set
  CHECK(encode_coco_rle({0, 20}) == "0d0");                               // all set
  CHECK(encode_coco_rle({0, 1, 19}) == "01c0");                           // the first alone
  CHECK(encode_coco_rle({19, 1}) == "c01");                               // the last alone
  CHECK(encode_coco_rle({15, 3, 4, 3, 4, 3, 22, 1, 8}) == "?34000b0NB");  // two boxes in 9 x 7 px
  CHECK(encode_coco_rle({1, 1, 1, 1, 1, 2, 1, 1, 1, 1, 2, 1, 1, 1, 1, 2, 1, 1, 1, 1, 2, 1, 1, 1, 1, 1}) ==
        "1110010O0010O0010O0010O000");  // a checkerboard, 5 x 6 px
}

TEST_CASE("The COCO API's strings are read back") {
  // A disk of radius 10 px about (300, 200) in 640 x 512 px.
  const RunLengths disk = decode_coco_rle("XVa41k?8J4M2N2O0O2O00000O20N1000001N101N2N3L6HlYT5");
  REQUIRE(disk.size() == 43);
  CHECK(RunLengths(disk.begin(), disk.begin() + 8) == RunLengths{148680, 1, 507, 9, 501, 13, 498, 15});
  std::uint64_t pixels = 0;
  std::uint64_t set = 0;
  for (std::size_t i = 0; i < disk.size(); ++i) {
    pixels += disk[i];
    set += i % 2 == 1 ? disk[i] : 0;
  }
  CHECK(pixels == 640 * 512);
  CHECK(set == 317);  // lattice points within a circle of radius 10
  CHECK(encode_coco_rle(disk) == "XVa41k?8J4M2N2O0O2O00000O20N1000001N101N2N3L6HlYT5");
}

TEST_CASE("Any counts survive being written and read") {
  std::mt19937 random(1);
  for (int i = 0; i < 5000; ++i) {
    const RunLengths counts = random_counts(random);
    const std::string text = encode_coco_rle(counts);
    CAPTURE(text);
    REQUIRE(decode_coco_rle(text) == counts);
  }
}

TEST_CASE("The largest steps up and down survive too") {
  const RunLengths counts = {kLargest, 0, kLargest, kLargest, 0, 0, kLargest};
  CHECK(decode_coco_rle(encode_coco_rle(counts)) == counts);
  CHECK(decode_coco_rle("").empty());
}

TEST_CASE("A string that no mask can have is an error that shows it") {
  const auto fault_in = [](const std::string& text) {
    return message_of<DataError>([&] { (void)decode_coco_rle(text); });
  };
  CHECK(fault_in("P") == "run lengths \"P\" are not a COCO mask");      // says more follows, but nothing does
  CHECK(fault_in("1 2") == "run lengths \"1 2\" are not a COCO mask");  // not a character of the code
  CHECK(fault_in("1p") == "run lengths \"1p\" are not a COCO mask");    // nor is the one after its last
  CHECK(fault_in("@") == "run lengths \"@\" are not a COCO mask");      // a negative count
  CHECK(fault_in("001N") == "run lengths \"001N\" are not a COCO mask");  // so is 0 and then 2 fewer
  CHECK(fault_in("oooooooo0") == "run lengths \"oooooooo0\" are not a COCO mask");  // past 32 bits
}

}  // namespace rle_test
