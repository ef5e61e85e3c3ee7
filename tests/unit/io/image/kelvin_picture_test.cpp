#include "io/image/kelvin_picture.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "io/image/pictures.h"
#include "io/image/png.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"
#include "support/tiff_bytes.h"

namespace kelvin_picture_test {

using namespace thermal;

namespace {

constexpr const char* kScaled =
    "<GDALMetadata><Item name=\"OFFSET\" sample=\"0\" role=\"offset\">0</Item>"
    "<Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.01</Item></GDALMetadata>";

/// All counts of 16 bits that are temperatures at 0.01 K per count, and the coldest of them in place of others.
Plane<std::uint16_t> all_counts() {
  constexpr std::size_t kColdest = 10000;
  Plane<std::uint16_t> plane(256, 256);
  for (std::size_t k = 0; k < plane.size(); ++k)
    plane.pixels()[k] = static_cast<std::uint16_t>(std::max(k, kColdest));
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
  const TestFolder folder;
  const Plane<std::uint16_t> counts = all_counts();
  const Plane<float> kelvin = kelvin_of(counts);
  write_file_atomically(folder.path() / "a.tif", encode_tiff(kelvin, {}));
  write_file_atomically(folder.path() / "b.tif", encode_tiff(counts, {.gdal_metadata = kScaled}));
  write_file(folder.path() / "c.png", encode_png(counts));
  CHECK(read_kelvin_picture(folder.path() / "a.tif") == kelvin);
  CHECK(read_kelvin_picture(folder.path() / "b.tif") == kelvin);
  CHECK(read_kelvin_picture(folder.path() / "c.png", {.kelvin_per_count = 0.01}) == kelvin);
}

TEST_CASE("A given scale replaces the one of the tags, and floats have none") {
  const TestFolder folder;
  const Plane<std::uint16_t> counts(8, 8, 7500);
  write_file_atomically(folder.path() / "a.tif", encode_tiff(counts, {.gdal_metadata = kScaled}));
  CHECK(read_kelvin_picture(folder.path() / "a.tif", {.kelvin_per_count = 0.04}).at(3, 3) == 300.0F);
  write_file_atomically(folder.path() / "b.tif", encode_tiff(Plane<float>(8, 8, 300.0F), {}));
  CHECK(read_kelvin_picture(folder.path() / "b.tif", {.kelvin_per_count = 0.04}).at(3, 3) == 300.0F);
}

TEST_CASE("Pictures without temperatures") {
  const TestFolder folder;
  const Path file = folder.path() / "a.tif";
  const auto fault_of = [&](const std::string& bytes) {
    write_file_atomically(file, bytes);
    return message_of<DataError>([&] { (void)read_kelvin_picture(file); });
  };
  CHECK(fault_of(encode_tiff(Plane<std::uint16_t>(8, 8, 30000), {})) ==
        file.string() +
            ": scale of its counts = unknown; expected kelvin per count in its tags or as an option: "
            "--kelvin-per-count 0.01, or 0.1 with --unit celsius for tenths of a degree");
  CHECK(fault_of("no TIFF") == file.string() + ": it begins as no PNG, JPEG or TIFF does");
  CHECK_THAT(fault_of(std::string("II*\0", 4)), StartsWith(file.string() + ": damaged: "));
  CHECK(fault_of(encode_tiff(Plane<std::uint16_t>(8, 8, 30000),
                             {.gdal_metadata = "<Item role=\"scale\">x</Item>"}))
            .find("scale of its counts = unknown") != std::string::npos);
}

TEST_CASE("Degrees Celsius: floats, and counts of tenths, by an option or by the unit of the tags") {
  const TestFolder folder;
  const auto read = [&folder](const TiffPage& page, const StoredScale& scale) {
    return read_kelvin_picture(folder.file("a.tif", TiffBytes().add(page).bytes()), scale);
  };
  Plane<float> kelvin(2, 2);
  std::ranges::copy(std::vector<float>{248.15F, 273.15F, 292.25F, 303.15F}, kelvin.pixels().begin());
  const TiffPage floats = tiff_page<float>(2, 2, {-25, 0, 19.1F, 30});
  CHECK(read(floats, {.unit = TemperatureUnit::celsius}) == kelvin);
  CHECK(read(tiff_page<double>(2, 2, {-25, 0, 19.1, 30}), {.unit = TemperatureUnit::celsius}) == kelvin);
  TiffPage tenths = tiff_page<std::int16_t>(2, 2, {-250, 0, 191, 300});
  CHECK(read(tenths, {.kelvin_per_count = 0.1, .unit = TemperatureUnit::celsius}) == kelvin);
  for (const char* unit : {"C", "deg C",
                           "\xc2\xb0"
                           "C",
                           "Celsius", "degrees_Celsius"}) {
    tenths.metadata = fmt::format(
        R"(<Item role="scale">0.1</Item><Item role="offset">0</Item><Item role="unittype">{}</Item>)", unit);
    CHECK(read(tenths, {}) == kelvin);
  }
  CHECK(read(tiff_page<float>(2, 1, {300, 301}), {.unit = TemperatureUnit::kelvin}).at(1, 0) == 301);
  TiffPage odd = floats;
  odd.metadata = R"(<Item role="unittype">F</Item>)";
  CHECK(message_of<DataError>([&] { (void)read(odd, {}); }) ==
        (folder.path() / "a.tif").string() + ": UNITTYPE of its tags = \"F\"; expected K or C");
}

TEST_CASE("Temperatures that no scene has are refused with the value and how many there are") {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kMost = std::numeric_limits<float>::max();
  const TestFolder folder;
  const Path file = folder.path() / "a.tif";
  const auto fault_of = [&](const TiffPage& page, const StoredScale& scale = {}) {
    write_file_atomically(file, TiffBytes().add(page).bytes());
    return message_of<DataError>([&] { (void)read_kelvin_picture(file, scale); })
        .substr(file.string().size());
  };
  const auto page_with = [](float value) {
    return tiff_page<float>(4, 2, {290, 291, 292, value, 293, 294, value, 295});
  };
  for (const auto& [value, words] : std::vector<std::pair<float, std::string>>{{-9999, "-9999 K"},
                                                                               {0, "0 K"},
                                                                               {kNaN, "nan K"},
                                                                               {kMost, "3.40282e+38 K"},
                                                                               {-kMost, "-3.40282e+38 K"},
                                                                               {2001, "2001 K"}}) {
    CHECK(fault_of(page_with(value)) == ": 2 of 8 pixels are no temperatures, the first at (3, 0) = " +
                                            words + "; expected 100 to 2000 K in every pixel");
  }
  CHECK(fault_of(tiff_page<std::int16_t>(2, 2, {150, 160, 170, -9999}),
                 {.kelvin_per_count = 0.1, .unit = TemperatureUnit::celsius}) ==
        ": 1 of 4 pixels are no temperatures, the first at (1, 1) = -726.75 K (-9999 as stored); expected "
        "100 to "
        "2000 K in every pixel");
  CHECK(fault_of(tiff_page<float>(2, 1, {kNaN, kNaN})).starts_with(": median of the pixels = nan K"));
}

TEST_CASE("The median is one of a drone's scene, and the message says what may be wrong") {
  const TestFolder folder;
  const Path file = folder.path() / "a.tif";
  const auto fault_of = [&](const std::string& tiff, const StoredScale& scale = {}) {
    write_file_atomically(file, tiff);
    return message_of<DataError>([&] { (void)read_kelvin_picture(file, scale); })
        .substr(file.string().size());
  };
  const std::string rule = "; expected 220 to 350 K (-53.15 to 76.85 deg C); ";
  const std::string check = "check unit and scale (--real-unit, --real-kelvin-per-count)";
  const StoredScale hundredths = {.kelvin_per_count = 0.01, .prefix = "--real-"};
  CHECK(fault_of(encode_tiff(Plane<std::uint16_t>(4, 4, 20732), {}), hundredths) ==
        ": median of the pixels = 207.32 K (-65.83 deg C)" + rule + check);
  const StoredScale low_gain = {.kelvin_per_count = 0.4, .prefix = "--real-"};
  CHECK(fault_of(encode_tiff(Plane<std::uint16_t>(4, 4, 7300), {}), low_gain) ==
        ": median of the pixels = 2920 K (2646.85 deg C)" + rule + check);
  CHECK(fault_of(encode_tiff(Plane<float>(4, 4, 21.5F), {})) ==
        ": median of the pixels = 21.5 K (-251.65 deg C)" + rule +
            "if these are degrees Celsius, add --unit celsius");
  for (const float edge : {220.0F, 350.0F}) {
    write_file_atomically(file, encode_tiff(Plane<float>(4, 4, edge), {}));
    CHECK(read_kelvin_picture(file).at(0, 0) == edge);
  }
}

TEST_CASE("Pixels without a value by GDAL's tag, a mask or pages are refused, smaller copies ignored") {
  const TestFolder folder;
  const Path file = folder.path() / "a.tif";
  const auto fault_of = [&](const TiffBytes& tiff) {
    write_file_atomically(file, tiff.bytes());
    return message_of<DataError>([&] { (void)read_kelvin_picture(file); }).substr(file.string().size());
  };
  TiffPage page = tiff_page<float>(2, 2, {290, 291, 300, 300});
  for (const char* no_data : {"300", "300.0", " 300 ", "3e2"}) {
    page.no_data = no_data;
    CHECK(fault_of(TiffBytes().add(page)) ==
          ": 2 of 4 pixels have no value (GDAL_NODATA = 300), the first at (0, 1); "
          "expected a temperature in every pixel");
  }
  page.no_data = "nodata";
  CHECK(fault_of(TiffBytes().add(page)) == ": GDAL_NODATA = \"nodata\"; expected a number");
  TiffPage empty = tiff_page<float>(2, 1, {290, std::numeric_limits<float>::quiet_NaN()});
  empty.no_data = "nan";
  CHECK(fault_of(TiffBytes().add(empty)).starts_with(": 1 of 2 pixels have no value (GDAL_NODATA = nan)"));
  page.no_data = "-9999";
  TiffPage other = tiff_page<std::uint8_t>(1, 1, {1});
  write_file_atomically(file, TiffBytes().add(page).bytes());
  CHECK(read_kelvin_picture(file).at(0, 1) == 300);
  other.kind = 1;
  write_file_atomically(file, TiffBytes().add(page).add(other).bytes());
  CHECK(read_kelvin_picture(file).at(0, 1) == 300);
  other.kind = 4;
  CHECK(fault_of(TiffBytes().add(page).add(other)) ==
        ": has a mask of pixels without a value; expected a picture of all pixels");
  CHECK(fault_of(TiffBytes().add(page).add(page)) ==
        ": has several pages; expected one picture in each file");
}

TEST_CASE("Temperatures whose largest is black are refused") {
  const TestFolder folder;
  TiffPage page = tiff_page<std::uint16_t>(2, 1, {30000, 30001});
  page.photometric = 0;
  const Path file = folder.file("a.tif", TiffBytes().add(page).bytes());
  CHECK(message_of<DataError>([&] { (void)read_kelvin_picture(file, {.kelvin_per_count = 0.01}); }) ==
        file.string() +
            ": PhotometricInterpretation = 0 (white is zero); expected 1: larger values are warmer");
}

TEST_CASE("A file that claims more than it can hold takes no memory for it") {
  const TestFolder folder;
  const std::string tiff = encode_tiff(Plane<float>(8, 8, 300.0F), {});
  const auto [name, content, claim] = GENERATE_REF(table<const char*, std::string, const char*>(
      {{"wide.tif", with_large_claim(tiff), "size = 15000 x 15000 px of 4 bytes each"},
       {"deep.tif", with_deep_claim(tiff), "size = 200 x 200 px of 4000 bytes each"},
       {"tall.tif", with_tall_claim(tiff), "strips = 8 x 1296911693 px of 4 bytes each"}}));
  const Path file = folder.file(name, content);
  const std::string words = fmt::format("{}: {}; expected what a file of {} bytes can hold", file.string(),
                                        claim, std::filesystem::file_size(file));
  CHECK(message_of<DataError>([&] { (void)read_kelvin_picture(file); }) == words);
  CHECK(message_of<DataError>([&] { (void)read_grey_picture(file); }) == words);
  CHECK(message_of<DataError>([&] { (void)as_jpeg(file, 16); }) == words);
}

TEST_CASE("A strip may have fewer rows than it says, as many writers have it") {
  const TestFolder folder;
  const Plane<float> kelvin(8, 8, 300.0F);
  std::string tiff = encode_tiff(kelvin, {});
  tiff.replace(value_of_tag(tiff, kRowsPerStrip), 2, "\xff\xff");
  CHECK(read_kelvin_picture(folder.file("a.tif", tiff)) == kelvin);
}

TEST_CASE("A TIFF whose pixels end early is damaged, however it is read") {
  const TestFolder folder;
  const auto [name, content] = GENERATE(table<const char*, std::string>(
      {{"floats.tif", with_long_rows(encode_tiff(Plane<float>(8, 8, 300.0F), {}))},
       {"counts.tif", with_long_rows(encode_tiff(Plane<std::uint16_t>(8, 8, 7500), {}))}}));
  const Path file = folder.file(name, content);
  const std::string words = file.string() + ": damaged: ";
  CHECK_THAT(message_of<DataError>([&] { (void)read_kelvin_picture(file, {.kelvin_per_count = 0.04}); }),
             StartsWith(words));
  CHECK_THAT(message_of<DataError>([&] { (void)as_jpeg(file, 16); }), StartsWith(words));
}

TEST_CASE("Counts that end early are no grey picture") {
  const TestFolder folder;
  const Path file = folder.file("a.tif", with_long_rows(encode_tiff(Plane<std::uint16_t>(8, 8, 7500), {})));
  CHECK_THAT(message_of<DataError>([&] { (void)read_grey_picture(file); }),
             StartsWith(file.string() + ": damaged: "));
}

}  // namespace kelvin_picture_test
