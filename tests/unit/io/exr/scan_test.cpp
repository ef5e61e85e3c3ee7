#include <cstring>

#include "base/error.h"
#include "io/exr/header_check.h"
#include "support/catch.h"
#include "support/exr.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace exr_scan_test {

using namespace thermal;

namespace {

template <typename T>
std::string bytes_of(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

const std::string kZero(1, '\0');

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + kZero + type + kZero + bytes_of(static_cast<std::int32_t>(value.size())) + value;
}

std::string box(const std::string& name, std::int32_t left, std::int32_t top, std::int32_t right,
                std::int32_t bottom) {
  return attribute(name, "box2i", bytes_of(left) + bytes_of(top) + bytes_of(right) + bytes_of(bottom));
}

const std::string kDisplay = box("displayWindow", 0, 0, 7, 5);

/// A data window after a valid display window.
std::string window(std::int32_t left, std::int32_t top, std::int32_t right, std::int32_t bottom) {
  return kDisplay + box("dataWindow", left, top, right, bottom);
}

std::string tiles(std::uint32_t width, std::uint32_t height) {
  return attribute("tiles", "tiledesc", bytes_of(width) + bytes_of(height) + kZero);
}

std::string one_channel(std::int32_t type) {
  return attribute("channels", "chlist",
                   std::string("Z") + kZero + bytes_of(type) + std::string(12, '\0') + kZero);
}

const std::string kMagic = bytes_of(20000630);
const std::string kRle = attribute("compression", "compression", std::string(1, '\1'));
const std::string kWindow = window(0, 0, 7, 5);  // 8 x 6 px: 6 chunks of RLE, 48 bytes of table

std::string file_of(std::int32_t version, const std::string& headers, std::size_t after = 48) {
  return kMagic + bytes_of(version) + headers + kZero + std::string(after, '\0');
}

std::string fault_in(const std::string& bytes, const ExrLimits& limits = {}) {
  const TestFolder folder;
  const Path file = folder.file("f.exr", bytes);
  return message_of<DataError>([&] { check_exr_headers(file, limits); });
}

const std::string kNone = "(no fault was thrown)";

}  // namespace

TEST_CASE("Consistent headers pass") {
  CHECK(fault_in(file_of(2, kRle + kWindow + one_channel(2))) == kNone);
  CHECK(fault_in(file_of(2 | 0x200, kRle + kWindow + tiles(4, 4), 4 * 8)) == kNone);  // 2 x 2 tiles
  CHECK(fault_in(file_of(2 | 0x1000, kRle + kWindow + kZero + kRle + kWindow + kZero, 2 * 48)) == kNone);
}

TEST_CASE("Other files than EXR with flat pixels are reported") {
  CHECK(fault_in("") == "not an EXR file (wrong first bytes)");
  CHECK(fault_in("\x89PNG\r\n\x1a\n") == "not an EXR file (wrong first bytes)");
  CHECK(fault_in(file_of(3, kRle + kWindow)) == "version = 3; expected 2");
  CHECK(fault_in(file_of(2 | 0x800, kRle + kWindow)) == "holds deep data; expected flat pixels");
  CHECK(fault_in(file_of(2 | 0x1000, "")) == "has no parts; expected at least one");
  CHECK(fault_in(file_of(2, kRle)) == "part 0: no dataWindow; expected one");
  CHECK(fault_in(file_of(2, kRle + box("dataWindow", 0, 0, 7, 5))) ==
        "part 0: no displayWindow; expected one");
  CHECK(fault_in(file_of(2, kWindow)) == "part 0: no compression; expected one");
  CHECK(fault_in(file_of(2, kWindow + attribute("compression", "compression", "\x63"))) ==
        "compression = 99; expected 0 (none) to 9 (DWAB)");
}

TEST_CASE("A file that ends within its headers is reported") {
  const std::string whole = file_of(2, kRle + kWindow + one_channel(2), 0);
  for (std::size_t size = 8; size < whole.size(); ++size) {
    CHECK_THAT(fault_in(whole.substr(0, size)), ContainsSubstring("at most the"));
  }
  CHECK(fault_in(whole) == "table of chunks = 48 bytes; expected at most the 0 left in the file");
}

TEST_CASE("A length beyond the end of the file costs no memory") {
  const std::string claim =
      std::string("comment") + kZero + "string" + kZero + bytes_of(std::int32_t{2'000'000'000});
  CHECK(fault_in(file_of(2, kRle + kWindow + claim, 0)) ==
        "part 0: comment = 2000000000 bytes; expected at most the 1 left in the file");
  const std::string negative = std::string("comment") + kZero + "string" + kZero + bytes_of(std::int32_t{-5});
  CHECK(fault_in(file_of(2, negative, 0)) ==
        "part 0: comment = -5 bytes; expected at most the 1 left in the file");
  CHECK(fault_in(file_of(2, std::string(40, 'n'))) ==
        "name of an attribute = over 31 characters; expected fewer");
}

TEST_CASE("An empty or inverted window is reported") {
  CHECK(fault_in(file_of(2, kRle + window(0, 0, 7, -1))) ==
        "part 0: dataWindow = 8 x 0 px; expected sides of at least 1");
  CHECK(fault_in(file_of(2, kRle + window(9, 0, 7, 5))) ==
        "part 0: dataWindow = -1 x 6 px; expected sides of at least 1");
  CHECK(fault_in(file_of(2, kRle + box("dataWindow", 0, 0, 7, 5) + box("displayWindow", 0, 0, -1, 5))) ==
        "part 0: displayWindow = 0 x 6 px; expected sides of at least 1");
  CHECK(fault_in(file_of(2 | 0x200, kRle + kWindow + tiles(0, 4))) ==
        "part 0: tiles = 0 x 4 px; expected sides of at least 1");
}

TEST_CASE("A window with more pixels than the limit is reported, with the option to raise it") {
  constexpr std::int32_t kFar = 2'147'483'647;
  const std::string rule = "; expected at most 256 (see --max-megapixels)";
  CHECK(fault_in(file_of(2, kRle + window(0, 0, kFar, 0))) ==
        "part 0: dataWindow = 2147483648 x 1 px, 2147.483648 megapixels" + rule);
  CHECK(fault_in(file_of(2, kRle + window(-kFar - 1, 0, kFar, 0))) ==
        "part 0: dataWindow = 4294967296 x 1 px, 4294.967296 megapixels" + rule);
  CHECK(fault_in(file_of(2, kRle + window(0, 0, 15'999, 16'000))) ==
        "part 0: dataWindow = 16000 x 16001 px, 256.016 megapixels" + rule);
  CHECK(fault_in(
            file_of(2, kRle + box("dataWindow", 0, 0, 7, 5) + box("displayWindow", 0, 0, 46'340, 46'340))) ==
        "part 0: displayWindow = 46341 x 46341 px, 2147.488281 megapixels" + rule);
  CHECK(fault_in(file_of(2, kRle + kWindow), {.pixels = 47}) ==
        "part 0: dataWindow = 8 x 6 px, 4.8e-05 megapixels; expected at most 4.7e-05 (see --max-megapixels)");
  CHECK(fault_in(file_of(2, kRle + kWindow + one_channel(2)), {.pixels = 48}) == kNone);
  CHECK(fault_in(file_of(2 | 0x200, kRle + kWindow + tiles(65'536, 65'536))) ==
        "part 0: tiles = 65536 x 65536 px, 4294.967296 megapixels" + rule);
}

TEST_CASE("More pixels than a file of its length can hold are reported") {
  // 4e8 bytes of pixels need 4e8 / 65536 = 6104 bytes of file; the table of 4 chunks takes only 32 of them.
  const std::string dwab = attribute("compression", "compression", "\x09");
  CHECK(fault_in(file_of(2, dwab + window(0, 0, 99'999, 999) + one_channel(2), 6'000)) ==
        "part 0: pixels = 400000000 bytes; expected what the 6000 bytes left in the file can hold");
  CHECK(fault_in(file_of(2, dwab + window(0, 0, 99'999, 999) + one_channel(2), 6'200)) == kNone);
}

TEST_CASE("Channels and parts are counted, and chunks are limited by the length of the file") {
  CHECK(fault_in(file_of(2, kRle + kWindow + one_channel(2)), {.channels = 0}) ==
        "channels = 1; expected at most 0");
  CHECK(fault_in(file_of(2 | 0x1000, kRle + kWindow + kZero + kRle + kWindow + kZero, 96), {.parts = 1}) ==
        "parts = 2; expected at most 1");
  CHECK(fault_in(file_of(2, kRle + kWindow + one_channel(3))) ==
        "part 0: channels: type = 3; expected 0 (uint), 1 (half) or 2 (float)");
  CHECK(fault_in(file_of(2, kRle + kWindow + attribute("channels", "chlist", "Zoo"))) ==
        "part 0: channels ends within a channel; expected a complete list");
  CHECK(fault_in(file_of(2, kRle + kWindow + attribute("chunkCount", "int", bytes_of(1'000'000'000)))) ==
        "table of chunks = 8000000000 bytes; expected at most the 48 left in the file");
  CHECK(fault_in(file_of(2, kRle + kWindow + attribute("chunkCount", "int", bytes_of(-1)))) ==
        "part 0: chunkCount = -1; expected 0 or more");
}

TEST_CASE("An attribute that a library interprets by name must have the right type") {
  CHECK(fault_in(file_of(2, kRle + kWindow + attribute("channels", "string", "Z"))) ==
        "part 0: channels: type = string; expected chlist");
  CHECK(fault_in(file_of(2, kRle + kWindow + attribute("lineOrder", "int", bytes_of(0)))) ==
        "part 0: lineOrder: type = int; expected lineOrder");
  CHECK(fault_in(file_of(2, kRle + kWindow + attribute("mine", "string", "Z"))) == kNone);
}

TEST_CASE("An attribute must be as long as its type, because libraries read that many bytes") {
  CHECK(fault_in(file_of(2, kRle + kWindow + attribute("mine", "v3f", std::string(16, '\0')))) ==
        "part 0: mine = 16 bytes; expected 12, as type v3f has");
  CHECK(fault_in(file_of(2, kRle + kWindow + attribute("mine", "floatvector", std::string(6, '\0')))) ==
        "part 0: mine = 6 bytes; expected a multiple of 4, as type floatvector has");
  CHECK(fault_in(file_of(2, kRle + kWindow + attribute("mine", "floatvector", std::string(8, '\0')))) ==
        kNone);
  CHECK(fault_in(file_of(2, kRle + kWindow + attribute("mine", "unheard of", std::string(6, '\0')))) ==
        kNone);
}

TEST_CASE("A channel list ends where its attribute does") {
  const std::string list = std::string("Z") + kZero + bytes_of(2) + std::string(12, '\0') + kZero;
  CHECK(fault_in(file_of(2, kRle + kWindow + attribute("channels", "chlist", list + "more"))) ==
        "part 0: channels continues after its end; expected a zero byte only at the end");
}

TEST_CASE("A preview must have as many pixels as it states") {
  const auto preview = [](std::uint32_t width, std::uint32_t height, std::size_t bytes) {
    return kRle + kWindow +
           attribute("preview", "preview", bytes_of(width) + bytes_of(height) + std::string(bytes, '\0'));
  };
  CHECK(fault_in(file_of(2, preview(2, 3, 24))) == kNone);
  CHECK(fault_in(file_of(2, preview(0, 3, 0))) == kNone);
  CHECK(fault_in(file_of(2, preview(2, 4, 24))) ==
        "part 0: preview = 2 x 4 px; expected 6 pixels, as its size has");
  CHECK(fault_in(file_of(2, preview(0xFFFFFFFF, 0xFFFFFFFF, 4))) ==
        "part 0: preview = 4294967295 x 4294967295 px; expected 1 pixels, as its size has");
}

TEST_CASE("Strings of a list must be within it") {
  const auto texts = [](const std::string& value) {
    return kRle + kWindow + attribute("multiView", "stringvector", value);
  };
  CHECK(fault_in(file_of(2, texts(bytes_of(4) + "left" + bytes_of(5) + "right"))) == kNone);
  CHECK(fault_in(file_of(2, texts(bytes_of(9) + "left"))) ==
        "part 0: multiView: text = 9 bytes; expected at most 4");
  CHECK(fault_in(file_of(2, texts(bytes_of(-1)))) ==
        "part 0: multiView: text = -1 bytes; expected at most 0");
  CHECK(fault_in(file_of(2, texts("abc"))) == "part 0: multiView = 3 bytes; expected more");
}

}  // namespace exr_scan_test
