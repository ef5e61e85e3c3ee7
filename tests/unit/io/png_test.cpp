#include "io/png.h"

#include <numeric>
#include <span>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

using namespace thermal;

namespace {

/// Every value of the type at least once, in an odd-sized picture.
template <typename T>
Plane<T> every_value(int width_px, int height_px) {
  Plane<T> picture(width_px, height_px);
  std::iota(picture.pixels().begin(), picture.pixels().end(), T{0});
  return picture;
}

template <typename T>
Path written(const TemporaryFolder& folder, const Plane<T>& picture) {
  Path file = folder / "picture.png";
  write_file(file, encode_png(picture));
  return file;
}

}  // namespace

TEST_CASE("8-bit pictures survive a PNG bit for bit") {
  const TemporaryFolder folder;
  const auto picture = every_value<std::uint8_t>(37, 11);
  CHECK(read_png8(written(folder, picture)) == picture);
}

TEST_CASE("16-bit pictures survive a PNG bit for bit") {
  const TemporaryFolder folder;
  const auto picture = every_value<std::uint16_t>(257, 259);
  CHECK(read_png16(written(folder, picture)) == picture);
}

TEST_CASE("A picture may be one pixel") {
  const TemporaryFolder folder;
  CHECK(read_png16(written(folder, Plane<std::uint16_t>(1, 1, 12345))).at(0, 0) == 12345);
}

TEST_CASE("The same picture makes the same bytes") {
  CHECK(encode_png(every_value<std::uint16_t>(64, 64)) == encode_png(every_value<std::uint16_t>(64, 64)));
}

TEST_CASE("A picture of the other depth is a fault that says so") {
  const TemporaryFolder folder;
  const Path shallow = written(folder, Plane<std::uint8_t>(2, 2, 9));
  CHECK(message_of<DataError>([&] { (void)read_png16(shallow); }) ==
        shallow.string() + ": 1 channels of uint8; expected 1 of uint16");
  const Path deep = written(folder, Plane<std::uint16_t>(2, 2, 9));
  CHECK(message_of<DataError>([&] { (void)read_png8(deep); }) ==
        deep.string() + ": 1 channels of uint16; expected 1 of uint8");
}

TEST_CASE("A file that is no picture cannot be read, and is named") {
  const TemporaryFolder folder;
  const Path text = folder.file("text.png", "no picture");
  CHECK_THAT(message_of<IoError>([&] { (void)read_png8(text); }), StartsWith("cannot read " + text.string()));
  const Path missing = folder / "missing.png";
  CHECK_THAT(message_of<IoError>([&] { (void)read_png8(missing); }),
             StartsWith("cannot read " + missing.string()));
}

// Not one that is cut short: OpenImageIO 2.4 then leaks its message (libpng's longjmp over its frames), which the
// leak sanitizer rightly reports.
TEST_CASE("A picture whose pixels have changed is damaged, and is named") {
  const TemporaryFolder folder;
  const Path file = written(folder, every_value<std::uint16_t>(100, 100));
  std::string bytes = read_file(file);
  for (std::size_t i = 0; i < 20; ++i) bytes[bytes.size() / 2 + i] = '\0';
  const Path damaged = folder.file("damaged.png", bytes);
  CHECK_THAT(message_of<DataError>([&] { (void)read_png16(damaged); }),
             StartsWith(damaged.string() + ": damaged: "));
}
