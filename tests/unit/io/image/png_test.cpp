#include "io/image/png.h"

#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/png_bytes.h"
#include "support/test_folder.h"

namespace png_test {

using namespace thermal;

namespace {

/// Every value of the type at least once if there are enough pixels.
template <typename T>
Plane<T> every_value(int width_px, int height_px) {
  Plane<T> picture(width_px, height_px);
  std::iota(picture.pixels().begin(), picture.pixels().end(), T{0});
  return picture;
}

/// Numerical Recipes' "quick and dirty" generator, of 16 bits.
class Dice {
 public:
  std::uint32_t operator()() {
    state_ = state_ * 1664525 + 1013904223;
    return state_ >> 16;
  }
  std::uint32_t below(std::uint32_t end) { return (*this)() % end; }

 private:
  std::uint32_t state_ = 1;
};

/// Independent pixels.
template <typename T>
Plane<T> noise(int width_px, int height_px) {
  Plane<T> picture(width_px, height_px);
  Dice dice;
  for (T& pixel : picture.pixels()) pixel = static_cast<T>(dice());
  return picture;
}

/// The least and the largest value alternating, so that every difference wraps round.
template <typename T>
Plane<T> extremes(int width_px, int height_px) {
  Plane<T> picture(width_px, height_px);
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x)
      picture.at(x, y) = (x + y) % 2 == 0 ? std::numeric_limits<T>::max() : T{0};
  return picture;
}

template <typename T>
Path written(const TestFolder& folder, const Plane<T>& picture) {
  Path file = folder / "picture.png";
  std::filesystem::remove(file);
  write_file(file, encode_png(picture));
  return file;
}

Plane<std::uint8_t> read_back(const TestFolder& folder, const Plane<std::uint8_t>& picture) {
  return read_png8(written(folder, picture));
}

Plane<std::uint16_t> read_back(const TestFolder& folder, const Plane<std::uint16_t>& picture) {
  return read_png16(written(folder, picture));
}

/// The message of read_png8() for these bytes, without the file's name.
std::string fault8(const std::string& bytes) {
  const TestFolder folder;
  const Path file = folder.file("picture.png", bytes);
  const std::string name = fmt::format("{}: ", file.string());
  const std::string message = message_of<DataError>([&] { (void)read_png8(file); });
  return message.starts_with(name) ? message.substr(name.size()) : fmt::format("not named: {}", message);
}

std::string fault8(int colour_type, int bit_depth, const std::string& samples) {
  const std::string palette = colour_type == 3 ? "abc" : "";
  return fault8(png_bytes::encode({.width_px = 1,
                                   .height_px = 1,
                                   .bit_depth = bit_depth,
                                   .colour_type = colour_type,
                                   .samples = samples,
                                   .palette = palette}));
}

}  // namespace

TEMPLATE_TEST_CASE("Pictures survive a PNG bit for bit", "", std::uint8_t, std::uint16_t) {
  const TestFolder folder;
  for (const auto& [width_px, height_px] :
       {std::pair(257, 259), {1, 1}, {1, 300}, {300, 1}, {2, 2}, {3, 5}, {4096, 1}, {1, 4096}, {37, 11}}) {
    CAPTURE(width_px, height_px);
    for (const auto& picture :
         {every_value<TestType>(width_px, height_px), noise<TestType>(width_px, height_px),
          extremes<TestType>(width_px, height_px), Plane<TestType>(width_px, height_px),
          Plane<TestType>(width_px, height_px, std::numeric_limits<TestType>::max())}) {
      CHECK(read_back(folder, picture) == picture);
    }
  }
}

TEST_CASE("Memory of a larger picture is reused without a trace of it") {
  std::vector<std::byte> file;
  encode_png(noise<std::uint16_t>(300, 200), file);
  const std::byte* const memory = file.data();
  const auto small = every_value<std::uint8_t>(5, 3);
  encode_png(small, file);
  CHECK(file == encode_png(small));
  CHECK(file.data() == memory);
}

// 655,872 bytes of rows are 2543 runs of at most 258 bytes, each of at least 2 bits: 636 bytes. ISA-L has a program for
// each kind of processor, and some of them need six times as many.
TEST_CASE("An image without light takes less than a hundredth of its pixels' space") {
  CHECK(encode_png(Plane<std::uint16_t>(640, 512)).size() < 640 * 512 * 2 / 100);
}

TEST_CASE("Noise takes as much space as it has bits, and hardly more") {
  const double pixels_bytes = 300 * 200 * 2;
  CHECK(static_cast<double>(encode_png(noise<std::uint16_t>(300, 200)).size()) < 1.01 * pixels_bytes);
}

TEST_CASE("The same picture makes the same bytes") {
  CHECK(encode_png(noise<std::uint16_t>(64, 64)) == encode_png(noise<std::uint16_t>(64, 64)));
  std::vector<std::byte> file = encode_png(noise<std::uint8_t>(64, 64));
  const std::vector<std::byte> first = file;
  encode_png(noise<std::uint8_t>(64, 64), file);
  CHECK(file == first);
}

// ISA-L's levels 1 and 2 fail this: for about one picture of a thousand, their output depends on the address.
TEST_CASE("The same picture gives the same bytes at any address in memory") {
  Dice dice;
  int different = 0;
  for (int turn = 0; turn < 4000; ++turn) {
    Plane<std::uint8_t> picture(1 + static_cast<int>(dice.below(60)), 1 + static_cast<int>(dice.below(60)));
    const std::uint32_t spread = 1 + dice.below(40);
    for (std::uint8_t& pixel : picture.pixels()) pixel = static_cast<std::uint8_t>(100 + dice.below(spread));
    const std::vector<std::byte> here = encode_png(picture);
    const std::vector<std::byte> in_the_way(2'000'000 + 4096 * dice.below(100));
    different += encode_png(picture) == here ? 0 : 1;
  }
  CHECK(different == 0);
}

TEST_CASE("A picture of another kind is an error that says so") {
  const TestFolder folder;
  const Path shallow = written(folder, Plane<std::uint8_t>(2, 2, 9));
  CHECK(message_of<DataError>([&] { (void)read_png16(shallow); }) ==
        fmt::format("{}: pixels = grey of 8 bits; expected grey of 16 bits", shallow.string()));
  CHECK(fault8(0, 16, "ab") == "pixels = grey of 16 bits; expected grey of 8 bits");
  CHECK(fault8(0, 4, "a") == "pixels = grey of 4 bits; expected grey of 8 bits");
  CHECK(fault8(2, 8, "abc") == "pixels = colour of 8 bits; expected grey of 8 bits");
  CHECK(fault8(3, 8, std::string(1, '\0')) == "pixels = palette of 8 bits; expected grey of 8 bits");
  CHECK(fault8(4, 8, "ab") == "pixels = grey and alpha of 8 bits; expected grey of 8 bits");
  CHECK(fault8(6, 8, "abcd") == "pixels = colour and alpha of 8 bits; expected grey of 8 bits");
}

TEST_CASE("A picture that claims more than its file can hold is an error") {
  const PngPicture picture = {.width_px = 40000, .height_px = 6000, .samples = "a"};
  const std::string bytes = png_bytes::encode(picture);
  CHECK(fault8(bytes) ==
        fmt::format("pixels = 240000000 bytes; expected what a file of {} bytes can hold", bytes.size()));
  CHECK(fault8(png_bytes::encode({.width_px = 2147483647, .height_px = 2147483647, .samples = "a"})) ==
        "size = 2147483647 x 2147483647 px; expected at most 256000000 pixels");
}

TEST_CASE("A file that is not a picture is an error, and a missing one cannot be read") {
  CHECK(fault8("no picture") == "not a PNG file, or its header is damaged");
  CHECK(fault8("") == "not a PNG file, or its header is damaged");
  const TestFolder folder;
  const Path missing = folder / "missing.png";
  CHECK(message_of<IoError>([&] { (void)read_png8(missing); }) ==
        fmt::format("cannot read {}: no such file", missing.string()));
}

TEST_CASE("A truncated picture is damaged, wherever it ends") {
  const TestFolder folder;
  const std::string bytes = read_file(written(folder, noise<std::uint8_t>(30, 30)));
  for (const std::size_t length : {34U, 60U, 500U, static_cast<unsigned>(bytes.size()) - 1}) {
    CAPTURE(length);
    CHECK(fault8(bytes.substr(0, length)) == "damaged: the file ends too soon");
  }
}

TEST_CASE("A picture with changed pixels is damaged") {
  const TestFolder folder;
  std::string bytes = read_file(written(folder, noise<std::uint8_t>(100, 100)));
  const std::size_t pixels_sum = bytes.size() - 12 - 4 - 4;  // before that of their chunk, and the last chunk
  const auto changed_at = [&bytes](std::size_t place) {
    std::string other = bytes;
    other[place] ^= 1;
    return fault8(other);
  };
  CHECK(changed_at(pixels_sum) == "damaged: IDAT: incorrect data check");
  CHECK(changed_at(pixels_sum - 30) == "damaged: IDAT: incorrect data check");
  CHECK(changed_at(pixels_sum + 4) == "damaged: IDAT: CRC error");
  CHECK(changed_at(bytes.size() - 1) == "damaged: IEND: CRC error");
}

}  // namespace png_test
