#include "base/error.h"
#include "io/image/pictures.h"
#include "io/image/png.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace grey_picture_test {

using namespace thermal;

namespace {

template <typename T>
Plane<T> ramp(int step) {
  Plane<T> plane(20, 20);
  for (std::size_t k = 0; k < plane.size(); ++k)
    plane.pixels()[k] = static_cast<T>(k * static_cast<std::size_t>(step));
  return plane;
}

}  // namespace

TEST_CASE("Grey PNGs of 8 and of 16 bits") {
  const TestFolder folder;
  write_file(folder.path() / "a.png", encode_png(ramp<std::uint8_t>(1)));
  write_file(folder.path() / "b.PNG", encode_png(ramp<std::uint16_t>(160)));
  const GreyPicture eight = read_grey_picture(folder.path() / "a.png");
  CHECK(eight.bits == 8);
  CHECK(eight.levels.at(7, 1) == 27);
  const GreyPicture sixteen = read_grey_picture(folder.path() / "b.PNG");
  CHECK(sixteen.bits == 16);
  CHECK(sixteen.levels.at(7, 1) == 27 * 160);
}

TEST_CASE("Names of pictures") {
  for (const char* name : {"a.png", "a.PNG", "a.jpg", "a.JPEG", "a.tif", "a.tiff"})
    CHECK(is_grey_picture(name));
  for (const char* name : {"a", "a.gif", "png", ".png", "a.png.txt"}) CHECK_FALSE(is_grey_picture(name));
}

TEST_CASE("Pictures that cannot be read") {
  const TestFolder folder;
  const Path file = folder.path() / "a.png";
  CHECK_THAT(message_of<IoError>([&] { (void)read_grey_picture(file); }),
             StartsWith("cannot read " + file.string()));
  write_file(file, {});
  CHECK_THAT(message_of<DataError>([&] { (void)read_grey_picture(file); }), StartsWith(file.string() + ": "));
}

TEST_CASE("Other formats are refused by their first bytes, whatever their name, before a decoder sees them") {
  const TestFolder folder;
  const std::string pgm = "P5\n2 2\n255\nabcd";  // a whole picture, which OpenImageIO could read
  for (const char* name : {"a.jpg", "a.tif"}) {
    const Path file = folder.file(name, pgm);
    CHECK(message_of<DataError>([&] { (void)read_grey_picture(file); }) ==
          file.string() + ": it begins as no PNG, JPEG or TIFF does");
    CHECK(message_of<DataError>([&] { (void)read_picture_size(file); }) ==
          file.string() + ": it begins as no PNG, JPEG or TIFF does");
  }
  // A name of another format's does not matter either.
  const TestFolder other;
  write_file(other.path() / "a.tif", encode_png(ramp<std::uint8_t>(1)));
  CHECK(read_grey_picture(other.path() / "a.tif").levels.at(7, 1) == 27);
  CHECK_THAT(message_of<IoError>([&] { (void)read_picture_size(other.path()); }),
             EndsWith("no regular file"));
}

}  // namespace grey_picture_test
