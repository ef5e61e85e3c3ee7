#include "io/image/index_picture.h"

#include <span>
#include <tuple>

#include <fmt/format.h>

#include "base/error.h"
#include "io/image/png.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/png_bytes.h"
#include "support/test_folder.h"

namespace index_picture_test {

using namespace thermal;

namespace {

ManifestObject object(std::uint16_t index, std::optional<Colour> colour = {}) {
  ManifestObject object;
  object.index = index;
  object.colour = colour;
  return object;
}

/// Ground and an actor, identified by numbers.
Manifest numbered(int width_px = 3, int height_px = 2) {
  Manifest manifest;
  manifest.camera = {
      .width_px = width_px, .height_px = height_px, .fx_px = 1, .fy_px = 1, .cx_px = 1, .cy_px = 1};
  manifest.objects = {object(1), object(7)};
  return manifest;
}

/// The same, identified by colours: ground brown, the actor red, the sky blue.
Manifest coloured(int width_px = 3, int height_px = 2) {
  Manifest manifest = numbered(width_px, height_px);
  manifest.objects = {object(1, Colour{90, 60, 30}), object(7, Colour{255, 0, 0})};
  manifest.sky_colour = {0, 0, 255};
  return manifest;
}

const std::string kSky = {'\0', '\0', '\xFF'};
const std::string kGround = {'\x5A', '\x3C', '\x1E'};
const std::string kActor = {'\xFF', '\0', '\0'};

/// A folder with one picture.
struct Png {
  explicit Png(const PngPicture& picture) : Png(png_bytes::encode(picture)) {}
  explicit Png(const std::string& bytes) : file(folder.file("000000.png", bytes)) {}
  [[nodiscard]] std::vector<std::uint16_t> read(const Manifest& manifest) const {
    const Passes passes = IndexPictures(manifest).read(file, {});
    CHECK(passes.ranks.empty());
    CHECK(passes.material_index.empty());
    CHECK(passes.object_index.width_px() == manifest.camera.width_px);
    return {passes.object_index.pixels().begin(), passes.object_index.pixels().end()};
  }
  /// Without the file's name.
  [[nodiscard]] std::string fault(const Manifest& manifest, const PassNeeds& needs = {},
                                  const ReadLimits& limits = {}) const {
    return without_name(
        message_of<DataError>([&] { (void)IndexPictures(manifest, limits).read(file, needs); }));
  }
  [[nodiscard]] std::string without_name(const std::string& message) const {
    const std::string name = fmt::format("{}: ", file.string());
    return message.starts_with(name) ? message.substr(name.size()) : "not named: " + message;
  }

  TestFolder folder;
  Path file;
};

PngPicture grey(const std::string& samples, int bit_depth = 8) {
  return {.width_px = 3,
          .height_px = 2,
          .bit_depth = bit_depth,
          .colour_type = 0,
          .samples = samples,
          .palette = "",
          .transparency = ""};
}

PngPicture colours(const std::string& samples, bool alpha = false) {
  return {.width_px = 3,
          .height_px = 2,
          .bit_depth = 8,
          .colour_type = alpha ? 6 : 2,
          .samples = samples,
          .palette = "",
          .transparency = ""};
}

using Indices = std::vector<std::uint16_t>;

}  // namespace

TEST_CASE("Pictures are recognised by their names") {
  CHECK(is_index_picture("a/000000.png"));
  CHECK(is_index_picture("a/000000.PNG"));
  CHECK_FALSE(is_index_picture("a/000000.exr"));
  CHECK_FALSE(is_index_picture("a.png/000000"));
}

TEST_CASE("Numbers of 8 bits are indices") {
  CHECK(Png(grey({'\0', '\1', '\7', '\x7F', '\x80', '\xFF'})).read(numbered()) ==
        Indices{0, 1, 7, 127, 128, 255});
}

TEST_CASE("Numbers of 16 bits are indices, the higher byte first") {
  CHECK(Png(grey({'\0', '\0', '\0', '\1', '\1', '\0', '\x7F', '\xFF', '\x12', '\x34', '\0', '\xFF'}, 16))
            .read(numbered()) == Indices{0, 1, 256, 32767, 0x1234, 255});
}

TEST_CASE("Numbers of fewer bits are not stretched") {
  CHECK(Png(grey({'\xA0', '\x40'}, 1)).read(numbered()) == Indices{1, 0, 1, 0, 1, 0});
  CHECK(Png(grey({'\x6C', '\x10'}, 2)).read(numbered()) == Indices{1, 2, 3, 0, 1, 0});
  CHECK(Png(grey({'\x7F', '\x10', '\x01', '\x80'}, 4)).read(numbered()) == Indices{7, 15, 1, 0, 1, 8});
}

TEST_CASE("A gamma changes no index") {
  PngPicture picture = grey({'\0', '\1', '\7', '\x7F', '\x80', '\xFF'});
  picture.gamma_100000 = 45455;
  CHECK(Png(picture).read(numbered()) == Indices{0, 1, 7, 127, 128, 255});
  PngPicture in_colours = colours(kSky + kGround + kActor + kActor + kSky + kGround);
  in_colours.gamma_100000 = 100000;
  CHECK(Png(in_colours).read(coloured()) == Indices{0, 1, 7, 7, 0, 1});
}

TEST_CASE("Colours are those of the objects and of the sky") {
  CHECK(Png(colours(kSky + kGround + kActor + kActor + kSky + kGround)).read(coloured()) ==
        Indices{0, 1, 7, 7, 0, 1});
}

TEST_CASE("A palette's colours are looked up, at any bit depth") {
  PngPicture picture = {.width_px = 3,
                        .height_px = 2,
                        .bit_depth = 8,
                        .colour_type = 3,
                        .samples = {'\2', '\1', '\0', '\0', '\1', '\2'},
                        .palette = kActor + kGround + kSky,
                        .transparency = ""};
  CHECK(Png(picture).read(coloured()) == Indices{0, 1, 7, 7, 1, 0});
  picture.bit_depth = 2;
  picture.samples = {'\x90', '\x18'};  // 2 1 0, 0 1 2
  CHECK(Png(picture).read(coloured()) == Indices{0, 1, 7, 7, 1, 0});
}

TEST_CASE("Interlaced pictures are read like others") {
  std::string samples;
  Indices expected;
  for (int i = 0; i < 13 * 11; ++i) {
    samples.push_back(static_cast<char>(i));
    expected.push_back(static_cast<std::uint16_t>(i));
  }
  const PngPicture picture = {.width_px = 13,
                              .height_px = 11,
                              .bit_depth = 8,
                              .colour_type = 0,
                              .samples = samples,
                              .palette = "",
                              .transparency = "",
                              .gamma_100000 = 0,
                              .interlaced = true};
  CHECK(Png(picture).read(numbered(13, 11)) == expected);
}

TEST_CASE("A picture may be one pixel, or one wide, or one high") {
  for (const auto& [width, height] : {std::pair(1, 1), {1, 200}, {200, 1}}) {
    std::string samples(static_cast<std::size_t>(width * height), '\7');
    const PngPicture picture = {.width_px = static_cast<std::uint32_t>(width),
                                .height_px = static_cast<std::uint32_t>(height),
                                .bit_depth = 8,
                                .colour_type = 0,
                                .samples = samples,
                                .palette = "",
                                .transparency = ""};
    CHECK(Png(picture).read(numbered(width, height)) == Indices(samples.size(), 7));
  }
}

TEST_CASE("Transparent pixels are sky, and colours with opaque alpha are kept") {
  const std::string opaque = "\xFF";
  const std::string clear(1, '\0');
  CHECK(Png(colours(kActor + opaque + kActor + clear + kGround + opaque + "abc" + clear + kSky + opaque +
                        kActor + opaque,
                    true))
            .read(coloured()) == Indices{7, 0, 1, 0, 0, 7});
  PngPicture numbers = grey({'\1', '\xFF', '\7', '\0', '\7', '\xFF', '\1', '\xFF', '\1', '\0', '\7', '\xFF'});
  numbers.colour_type = 4;
  CHECK(Png(numbers).read(numbered()) == Indices{1, 0, 7, 1, 0, 7});
  PngPicture palette = {.width_px = 3,
                        .height_px = 2,
                        .bit_depth = 8,
                        .colour_type = 3,
                        .samples = {'\2', '\1', '\0', '\0', '\1', '\2'},
                        .palette = kActor + kGround + kActor,
                        .transparency = {'\xFF', '\xFF', '\0'}};
  CHECK(Png(palette).read(coloured()) == Indices{0, 1, 7, 7, 1, 0});
}

TEST_CASE("A partly transparent pixel is an error") {
  const std::string opaque = "\xFF";
  const std::string edge = "\x80";
  CHECK(Png(colours(kActor + opaque + kActor + opaque + kGround + opaque + kSky + opaque + kActor + edge +
                        kSky + edge,
                    true))
            .fault(coloured()) ==
        "alpha at pixel (1, 1) = 128; expected 0 (sky) or 255, because a pixel belongs to one object");
  PngPicture deep = grey(std::string(20, '\0') + "\1\2\3\4", 16);
  deep.colour_type = 4;
  CHECK(Png(deep).fault(numbered()) ==
        "alpha at pixel (2, 1) = 772; expected 0 (sky) or 65535, because a pixel belongs to one object");
}

TEST_CASE("Grey is a colour if objects have colours") {
  Manifest manifest = coloured();
  manifest.objects[0].colour = Colour{9, 9, 9};
  manifest.sky_colour = {0, 0, 0};
  CHECK(Png(grey({'\0', '\x9', '\x9', '\x9', '\0', '\0'})).read(manifest) == Indices{0, 1, 1, 1, 0, 0});
  CHECK(Png(grey({'\0', '\1', '\x9', '\x9', '\0', '\0'})).fault(manifest) ==
        "colour at pixel (1, 0) = #010101 (1, 1, 1) (1 pixels); expected an object's or the sky's; did you "
        "mean #000000 "
        "(0, 0, 0)?");
  CHECK(Png(grey(std::string(11, '\0') + '\x9', 16)).read(manifest) ==
        Indices{0, 0, 0, 0, 0, 9});  // only numbers have 16 bits
}

TEST_CASE("An unknown colour is an error with place, number and the nearest ones") {
  const std::string edge = {'\xF0', '\x01', '\x02'};
  CHECK(Png(colours(kSky + kGround + edge + edge + "abc" + edge)).fault(coloured()) ==
        "colour at pixel (2, 0) = #f00102 (240, 1, 2) (3 pixels); expected an object's or the sky's; did you "
        "mean #ff0000 "
        "(255, 0, 0)?");
}

TEST_CASE("Colours without any in the manifest are an error") {
  CHECK(Png(colours(kSky + kGround + kActor + kActor + kSky + kGround)).fault(numbered()) ==
        "a picture of colours; expected objects[].colour in the manifest, or a grey picture of indices");
}

TEST_CASE("Colours with 16 bits are an error") {
  PngPicture picture = colours(std::string(36, '\0'));
  picture.bit_depth = 16;
  CHECK(Png(picture).fault(coloured()) == "bits per channel = 16; expected 8 in a picture of colours");
}

TEST_CASE("A number that is not an index is an error") {
  CHECK(Png(grey({'\0', '\0', '\0', '\1', '\x80', '\0', '\0', '\0', '\0', '\0', '\0', '\0'}, 16))
            .fault(numbered()) == "index at pixel (2, 0) = 32768; expected a whole number from 0 to 32767");
}

TEST_CASE("Two objects of one colour are an error") {
  const auto fault_of = [](const Manifest& manifest) {
    return message_of<DataError>([&] { (void)IndexPictures(manifest); });
  };
  Manifest manifest = coloured();
  manifest.objects[1].colour = manifest.objects[0].colour;
  CHECK(fault_of(manifest) ==
        "objects[1].colour = #5a3c1e (90, 60, 30); expected a colour other than objects[0].colour");
  manifest.objects[1].colour = Colour{0, 0, 255};
  CHECK(fault_of(manifest) ==
        "objects[1].colour = #0000ff (0, 0, 255); expected a colour other than sky_colour");
}

TEST_CASE("Planes that a picture cannot have are an error if they are needed") {
  const Png png(grey({'\0', '\1', '\7', '\1', '\1', '\1'}));
  CHECK(png.fault(numbered(), {.depth = true, .normals = true, .actors = false}) ==
        "no depth channel, which the chosen terms need; a picture of indices or colours has no other plane");
  CHECK(png.fault(numbered(), {.depth = false, .normals = true, .actors = false}) ==
        "no normal channel, which the chosen terms need; a picture of indices or colours has no other plane");
  CHECK(IndexPictures(numbered())
            .read(png.file, {.depth = false, .normals = false, .actors = true})
            .actor_index.empty());
}

TEST_CASE("A picture of another size is an error that accounts for supersampling and overscan") {
  const Png png(grey({'\0', '\1', '\7', '\1', '\1', '\1'}));
  CHECK(png.fault(numbered(2, 2)) == "size = 3 x 2 px; expected the manifest's 2 x 2 px");
  Manifest finer = numbered();
  finer.supersample = 2;
  finer.overscan_px = 1;
  CHECK(png.fault(finer) == "size = 3 x 2 px; expected the manifest's 10 x 8 px");
}

TEST_CASE("A header's claims are checked before memory is allocated") {
  PngPicture picture = grey({'\0', '\1', '\7', '\1', '\1', '\1'});
  CHECK(Png(picture).fault(numbered(), {}, {.pixels = 5}) == "size = 3 x 2 px; expected at most 5 pixels");
  picture.width_px = picture.height_px = 0x7FFFFFFF;
  const Png huge(picture);
  CHECK(huge.fault(numbered()) == "size = 2147483647 x 2147483647 px; expected the manifest's 3 x 2 px");
  const auto fault_of_survey = [](const Png& png) {
    return png.without_name(message_of<DataError>([&] { (void)survey_picture(png.file); }));
  };
  CHECK(fault_of_survey(huge) == "size = 2147483647 x 2147483647 px; expected at most 256000000 pixels");
  picture.width_px = picture.height_px = 16000;
  const std::string bytes = png_bytes::encode(picture);
  CHECK(fault_of_survey(Png(bytes)) ==
        fmt::format("pixels = 256000000 bytes; expected what a file of {} bytes can hold", bytes.size()));
}

TEST_CASE("Files that are not PNG are errors, whatever their names") {
  const std::string fault = "not a PNG file, or its header is damaged";
  const std::string good = png_bytes::encode(grey({'\0', '\1', '\7', '\1', '\1', '\1'}));
  CHECK(Png(std::string()).fault(numbered()) == fault);
  CHECK(Png(std::string("\xFF\xD8\xFF\xE0 a JPEG that is long enough to have a head")).fault(numbered()) ==
        fault);
  CHECK(Png(good.substr(0, 28)).fault(numbered()) == fault);
  const auto with = [&](std::size_t at, char byte) {
    std::string bytes = good;
    bytes[at] = byte;
    return Png(bytes).fault(numbered());
  };
  CHECK(with(24, '\3') == fault);  // bits
  CHECK(with(26, '\1') == fault);  // compression
  CHECK(with(27, '\1') == fault);  // filters
  CHECK(with(28, '\2') == fault);  // interlacing
  CHECK(with(25, '\5') == fault);  // colour type
  CHECK(with(25, '\x9') == fault);
  CHECK(with(19, '\0') == fault);  // width
  CHECK(with(16, '\x80') == fault);
}

namespace {

/// All possible numbers, several times, in rows on which filters have an effect.
PngPicture busy(int colour_type, int bit_depth, std::size_t channels) {
  PngPicture picture = {.width_px = 37, .height_px = 29, .bit_depth = bit_depth, .colour_type = colour_type};
  std::uint32_t state = 1;
  const std::size_t bytes = std::size_t{37} * 29 * channels * static_cast<std::size_t>(bit_depth) / 8;
  for (std::size_t i = 0; i < bytes; ++i) {
    state = state * 1664525 + 1013904223;
    picture.samples.push_back(static_cast<char>(i / 3 + (state >> 30)));
  }
  return picture;
}

/// All pixels of a picture, row by row.
std::vector<int> numbers_in(const Png& png) {
  std::vector<int> numbers;
  PngFile file(png.file);
  read_rows(file, [&numbers](int, std::span<const PicturePixel> row) {
    for (const PicturePixel& pixel : row) {
      numbers.insert(numbers.end(), {pixel.grey, pixel.alpha});
      numbers.insert(numbers.end(), pixel.colour.begin(), pixel.colour.end());
    }
  });
  return numbers;
}

}  // namespace

TEST_CASE("Filters are reversed, whatever the pixels are") {
  for (const auto& [colour_type, bit_depth, channels] :
       {std::tuple(0, 8, 1U), {0, 16, 1U}, {2, 8, 3U}, {4, 8, 2U}, {4, 16, 2U}, {6, 8, 4U}}) {
    PngPicture picture = busy(colour_type, bit_depth, channels);
    for (const bool interlaced : {false, true}) {
      picture.interlaced = interlaced;
      picture.filters = "";
      const std::vector<int> expected = numbers_in(Png(picture));
      for (const std::string& filters : {std::string("\1"), std::string("\2"), std::string("\3"),
                                         std::string("\4"), std::string("\4\3\2\1\0", 5)}) {
        CAPTURE(colour_type, bit_depth, interlaced, static_cast<int>(filters[0]));
        picture.filters = filters;
        CHECK(numbers_in(Png(picture)) == expected);
      }
    }
  }
}

TEST_CASE("The output of Veldt's own encoder is read") {
  Plane<std::uint16_t> picture(257, 64);
  for (std::size_t i = 0; i < picture.size(); ++i)
    picture.pixels()[i] = static_cast<std::uint16_t>(i * 2 % 32768);
  const TestFolder folder;
  write_file(folder / "own.png", encode_png(picture));
  CHECK(IndexPictures(numbered(257, 64)).read(folder / "own.png", {}).object_index == picture);
}

TEST_CASE("One grey or colour may be transparent") {
  PngPicture picture = grey({'\0', '\1', '\7', '\7', '\1', '\0'});
  picture.transparency = {'\0', '\7'};
  CHECK(Png(picture).read(numbered()) == Indices{0, 1, 0, 0, 1, 0});
  PngPicture in_colours = colours(kSky + kGround + kActor + "abc" + kSky + "abc");
  in_colours.transparency = {'\0', 'a', '\0', 'b', '\0', 'c'};
  CHECK(Png(in_colours).read(coloured()) == Indices{0, 1, 7, 0, 0, 0});
}

TEST_CASE("A truncated picture is never read as a picture") {
  std::string samples;
  for (int i = 0; i < 64 * 64; ++i) samples.push_back(static_cast<char>(i % 2));
  PngPicture picture = grey(samples);
  picture.width_px = picture.height_px = 64;
  const std::string whole = png_bytes::encode(picture);
  CHECK(Png(whole).read(numbered(64, 64)).size() == samples.size());
  for (std::size_t length = 33; length < whole.size(); length += length + 40 < whole.size() ? 31U : 1U) {
    CAPTURE(length);
    CHECK(Png(whole.substr(0, length)).fault(numbered(64, 64)) == "damaged: the file ends too soon");
  }
}

TEST_CASE("A damaged picture is an error that says what is wrong with it") {
  const PngPicture usual = grey({'\0', '\1', '\7', '\1', '\1', '\1'});
  const auto fault_of = [](const std::string& bytes) { return Png(bytes).fault(numbered()); };
  const auto fault_of_stream = [&](const std::string& stream) {
    return fault_of(png_bytes::encode(usual, stream));
  };
  std::string flipped = png_bytes::encode(usual);
  flipped[flipped.find("IDAT") + 12] ^= 1;
  CHECK(fault_of(flipped) == "damaged: IDAT: incorrect data check");
  std::string wrong_sum = png_bytes::zlib_stream(png_bytes::all_rows(usual));
  wrong_sum.back() ^= 1;
  CHECK(fault_of_stream(wrong_sum) == "damaged: IDAT: incorrect data check");
  CHECK(fault_of_stream("no stream at all") == "damaged: IDAT: incorrect header check");
  const std::string whole = png_bytes::zlib_stream(png_bytes::all_rows(usual));
  CHECK(fault_of_stream(whole.substr(0, whole.size() - 4)) == "damaged: Not enough image data");
  CHECK(fault_of_stream(whole + "more") == "damaged: IDAT: Extra compressed data");
  CHECK(fault_of_stream(png_bytes::zlib_stream(std::string(7, '\0'))) == "damaged: Not enough image data");
  CHECK(fault_of_stream(png_bytes::zlib_stream(std::string(9, '\0'))) ==
        "damaged: IDAT: Too much image data");
  CHECK(fault_of_stream(std::string(70000, '\0')) == "damaged: IDAT: unknown compression method");
  CHECK(fault_of_stream(png_bytes::zlib_stream(std::string(4, '\0') + "\5" + std::string(3, '\0'))) ==
        "damaged: bad adaptive filter value");
}

TEST_CASE("An invalid palette is an error") {
  PngPicture picture = {.width_px = 3,
                        .height_px = 2,
                        .bit_depth = 8,
                        .colour_type = 3,
                        .samples = {'\2', '\1', '\0', '\0', '\1', '\2'}};
  CHECK(Png(picture).fault(coloured()) == "damaged: IDAT: Missing PLTE before IDAT");
  picture.palette = kActor + kGround;
  CHECK(Png(picture).fault(coloured()) ==
        "damaged: a pixel's colour = 2; expected one of the 2 of its palette");
  picture.palette = "abcd";
  CHECK(Png(picture).fault(coloured()) == "damaged: PLTE: invalid");
  picture.palette = std::string(771, 'a');
  CHECK(Png(picture).fault(coloured()) == "damaged: PLTE: invalid");
}

TEST_CASE("Ancillary chunks are skipped, unknown critical ones are an error") {
  const std::string bytes = png_bytes::encode(grey({'\0', '\1', '\7', '\1', '\1', '\1'}));
  const auto with = [&](const std::string& chunk) {
    return Png(bytes.substr(0, 33) + chunk + bytes.substr(33));
  };
  CHECK(with(png_bytes::chunk("teXt", std::string(200000, 'x'))).read(numbered()) ==
        Indices{0, 1, 7, 1, 1, 1});
  CHECK(with(png_bytes::chunk("pHYs", "short")).read(numbered()) == Indices{0, 1, 7, 1, 1, 1});
  CHECK(with(png_bytes::chunk("NEED", "")).fault(numbered()) == "damaged: NEED: unhandled critical chunk");
  std::string wrong = png_bytes::chunk("teXt", "x");
  wrong.back() ^= 1;
  CHECK(with(wrong).fault(numbered()) == "damaged: teXt: CRC error");
  const std::string huge = with(std::string("\x7F\xFF\xFF\xFFteXtx")).fault(numbered());
  CHECK((huge == "damaged: teXt: chunk data is too large" ||
         huge == "damaged: the file ends too soon"));  // libpng 1.6.48
  CHECK(with(std::string("\x03\xFF\xFF\xFFzTXtx")).fault(numbered()) == "damaged: the file ends too soon");
}

TEST_CASE("A file that cannot be opened is an error that names it") {
  const TestFolder folder;
  const auto fault_of = [](const Path& file) {
    return message_of<IoError>([&] { (void)survey_picture(file); });
  };
  CHECK(fault_of(folder / "none.png") ==
        fmt::format("cannot read {}: no such file", (folder / "none.png").string()));
  std::filesystem::create_directory(folder / "folder.png");
  CHECK(fault_of(folder / "folder.png") ==
        fmt::format("cannot read {}: it is a folder; expected a file", (folder / "folder.png").string()));
}

TEST_CASE("A survey counts numbers") {
  const PictureSurvey survey = survey_picture(Png(grey({'\7', '\1', '\7', '\x2', '\x2', '\7'})).file);
  CHECK(survey.kind == PictureKind::grey8);
  CHECK(survey.width_px == 3);
  CHECK(survey.height_px == 2);
  REQUIRE(survey.uses.size() == 3);
  CHECK(survey.uses[0].value == 7);
  CHECK(survey.uses[0].pixels == 3);
  CHECK(survey.uses[1].value == 2);
  CHECK(survey.uses[2].value == 1);
  CHECK(survey_picture(Png(grey(std::string(12, '\1'), 16)).file).kind == PictureKind::grey16);
}

TEST_CASE("A survey counts colours, and transparent pixels separately") {
  const std::string opaque = "\xFF";
  const std::string clear = "\x10";
  const PictureSurvey survey =
      survey_picture(Png(colours(kActor + opaque + kSky + opaque + kGround + opaque + kGround + clear +
                                     kActor + opaque + kSky + clear,
                                 true))
                         .file);
  CHECK(survey.kind == PictureKind::colour);
  CHECK(survey.transparent_pixels == 2);
  CHECK(survey.other_pixels == 0);
  REQUIRE(survey.uses.size() == 3);
  CHECK(survey.uses[0].colour == Colour{255, 0, 0});
  CHECK(survey.uses[0].pixels == 2);
  CHECK(survey.uses[1].colour == Colour{0, 0, 255});
  CHECK(survey.uses[2].colour == Colour{90, 60, 30});
}

TEST_CASE("A survey of a photograph is limited") {
  std::string samples;
  for (int i = 0; i < 300 * 300; ++i)
    samples += {static_cast<char>(i), static_cast<char>(i >> 8), static_cast<char>(i >> 16)};
  const PngPicture picture = {.width_px = 300,
                              .height_px = 300,
                              .bit_depth = 8,
                              .colour_type = 2,
                              .samples = samples,
                              .palette = "",
                              .transparency = ""};
  const PictureSurvey survey = survey_picture(Png(picture).file);
  CHECK(survey.uses.size() == kMostPictureUses);
  CHECK(survey.other_pixels == 300 * 300 - 65536);
}

}  // namespace index_picture_test
