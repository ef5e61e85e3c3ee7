#include "io/image/kelvin_picture.h"

#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"
#include "io/image/grey_picture.h"
#include "io/image/jpeg.h"
#include "io/image/png.h"
#include "io/image/tiff.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace kelvin_picture_test {

using namespace thermal;

namespace {

constexpr const char* kScaled =
    "<GDALMetadata><Item name=\"OFFSET\" sample=\"0\" role=\"offset\">0</Item>"
    "<Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.01</Item></GDALMetadata>";

/// All counts of 16 bits.
Plane<std::uint16_t> all_counts() {
  Plane<std::uint16_t> plane(256, 256);
  for (std::size_t k = 0; k < plane.size(); ++k) plane.pixels()[k] = static_cast<std::uint16_t>(k);
  return plane;
}

Plane<float> kelvin_of(const Plane<std::uint16_t>& counts) {
  Plane<float> kelvin(counts.width_px(), counts.height_px());
  for (std::size_t k = 0; k < counts.size(); ++k)
    kelvin.pixels()[k] = static_cast<float>(counts.pixels()[k] * 0.01);
  return kelvin;
}

/// The place of the value of a tag below 512, of one number, in a little-endian TIFF.
std::size_t value_of_tag(const std::string& tiff, char low_byte) {
  const std::string name = {low_byte, '\1'};
  std::size_t at = 0;
  do at = tiff.find(name, at + 1);
  while (at != std::string::npos && tiff.substr(at + 4, 4) != std::string("\1\0\0\0", 4));
  REQUIRE(at != std::string::npos);
  return at + 8;
}

constexpr char kWidth = '\0';           // 256
constexpr char kHeight = '\1';          // 257
constexpr char kSamples = '\x15';       // 277
constexpr char kRowsPerStrip = '\x16';  // 278

/// A TIFF that says it is 15,000 px wide and high.
std::string with_large_claim(std::string tiff) {
  for (const char tag : {kWidth, kHeight}) tiff.replace(value_of_tag(tiff, tag), 2, "\x98\x3a");
  return tiff;
}

/// A TIFF that says it is 200 px wide and high, with 1,000 channels.
std::string with_deep_claim(std::string tiff) {
  for (const char tag : {kWidth, kHeight}) tiff.replace(value_of_tag(tiff, tag), 2, {'\xc8', '\0'});
  return tiff.replace(value_of_tag(tiff, kSamples), 2, "\xe8\x03");
}

/// A TIFF that says a strip has 1,296,911,693 rows.
std::string with_tall_claim(std::string tiff) {
  const std::size_t value = value_of_tag(tiff, kRowsPerStrip);
  tiff[value - 6] = '\4';  // of 32 bits
  return tiff.replace(value, 4, "MMMM");
}

/// A TIFF that says its rows are 2 px longer than they are.
std::string with_long_rows(std::string tiff) {
  tiff[value_of_tag(tiff, kWidth)] += 2;
  return tiff;
}

}  // namespace

TEST_CASE("Kelvin come back bit for bit: floats, counts with a scale in the tags, counts with one given") {
  const TemporaryFolder folder;
  const Plane<std::uint16_t> counts = all_counts();
  const Plane<float> kelvin = kelvin_of(counts);
  write_file_atomically(folder.path() / "a.tif", encode_tiff(kelvin, {}));
  write_file_atomically(folder.path() / "b.tif", encode_tiff(counts, {.gdal_metadata = kScaled}));
  write_file(folder.path() / "c.png", encode_png(counts));
  CHECK(read_kelvin_picture(folder.path() / "a.tif", {}) == kelvin);
  CHECK(read_kelvin_picture(folder.path() / "b.tif", {}) == kelvin);
  CHECK(read_kelvin_picture(folder.path() / "c.png", 0.01) == kelvin);
}

TEST_CASE("A given scale replaces the one of the tags, and floats have none") {
  const TemporaryFolder folder;
  const Plane<std::uint16_t> counts(8, 8, 7500);
  write_file_atomically(folder.path() / "a.tif", encode_tiff(counts, {.gdal_metadata = kScaled}));
  CHECK(read_kelvin_picture(folder.path() / "a.tif", 0.04).at(3, 3) == 300.0F);
  write_file_atomically(folder.path() / "b.tif", encode_tiff(Plane<float>(8, 8, 300.0F), {}));
  CHECK(read_kelvin_picture(folder.path() / "b.tif", 0.04).at(3, 3) == 300.0F);
}

TEST_CASE("Pictures without temperatures") {
  const TemporaryFolder folder;
  const Path file = folder.path() / "a.tif";
  const auto fault_of = [&](const std::string& bytes) {
    write_file_atomically(file, bytes);
    return message_of<DataError>([&] { (void)read_kelvin_picture(file, {}); });
  };
  const std::string rule = "; expected kelvin: finite, and 100 to 3000 for half of the pixels";
  CHECK(fault_of(encode_tiff(Plane<std::uint16_t>(8, 8, 30000), {})) ==
        file.string() +
            ": scale of its counts = unknown; expected kelvin per count in its tags or as an option");
  CHECK(fault_of(encode_tiff(Plane<float>(8, 8, 21.5F), {})) ==
        file.string() + ": median of the pixels = 21.5" + rule);
  Plane<float> broken(8, 8, 300.0F);
  broken.at(2, 2) = std::numeric_limits<float>::quiet_NaN();
  CHECK(fault_of(encode_tiff(broken, {})) == file.string() + ": pixels = not finite" + rule);
  CHECK(fault_of("no TIFF") == file.string() + ": it begins as no PNG, JPEG or TIFF does");
  CHECK_THAT(fault_of(std::string("II*\0", 4)), StartsWith(file.string() + ": damaged: "));
  CHECK(fault_of(encode_tiff(Plane<std::uint16_t>(8, 8, 30000),
                             {.gdal_metadata = "<Item role=\"scale\">x</Item>"}))
            .find("scale of its counts = unknown") != std::string::npos);
}

TEST_CASE("A file that claims more than it can hold takes no memory for it") {
  const TemporaryFolder folder;
  const std::string tiff = encode_tiff(Plane<float>(8, 8, 300.0F), {});
  const auto [name, content, claim] = GENERATE_REF(table<const char*, std::string, const char*>(
      {{"wide.tif", with_large_claim(tiff), "size = 15000 x 15000 px of 4 bytes each"},
       {"deep.tif", with_deep_claim(tiff), "size = 200 x 200 px of 4000 bytes each"},
       {"tall.tif", with_tall_claim(tiff), "strips = 8 x 1296911693 px of 4 bytes each"}}));
  const Path file = folder.file(name, content);
  const std::string words = fmt::format("{}: {}; expected what a file of {} bytes can hold", file.string(),
                                        claim, std::filesystem::file_size(file));
  CHECK(message_of<DataError>([&] { (void)read_kelvin_picture(file, {}); }) == words);
  CHECK(message_of<DataError>([&] { (void)read_grey_picture(file); }) == words);
  CHECK(message_of<DataError>([&] { (void)as_jpeg(file, 16); }) == words);
}

TEST_CASE("A strip may have fewer rows than it says, as many writers have it") {
  const TemporaryFolder folder;
  const Plane<float> kelvin(8, 8, 300.0F);
  std::string tiff = encode_tiff(kelvin, {});
  tiff.replace(value_of_tag(tiff, kRowsPerStrip), 2, "\xff\xff");
  CHECK(read_kelvin_picture(folder.file("a.tif", tiff), {}) == kelvin);
}

TEST_CASE("A TIFF whose pixels end early is damaged, however it is read") {
  const TemporaryFolder folder;
  const auto [name, content] = GENERATE(table<const char*, std::string>(
      {{"floats.tif", with_long_rows(encode_tiff(Plane<float>(8, 8, 300.0F), {}))},
       {"counts.tif", with_long_rows(encode_tiff(Plane<std::uint16_t>(8, 8, 7500), {}))}}));
  const Path file = folder.file(name, content);
  const std::string words = file.string() + ": damaged: ";
  CHECK_THAT(message_of<DataError>([&] { (void)read_kelvin_picture(file, 0.04); }), StartsWith(words));
  CHECK_THAT(message_of<DataError>([&] { (void)as_jpeg(file, 16); }), StartsWith(words));
}

TEST_CASE("Counts that end early are no grey picture") {
  const TemporaryFolder folder;
  const Path file = folder.file("a.tif", with_long_rows(encode_tiff(Plane<std::uint16_t>(8, 8, 7500), {})));
  CHECK_THAT(message_of<DataError>([&] { (void)read_grey_picture(file); }),
             StartsWith(file.string() + ": damaged: "));
}

}  // namespace kelvin_picture_test
