#include "io/system/tar_file.h"

#include <filesystem>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace tar_file_test {

using namespace thermal;

constexpr std::size_t kBlock = 512;

TEST_CASE("A tar file has a header block per file, whole blocks of content, and two empty blocks") {
  const TestFolder folder;
  const Path file = folder.path() / "a.tar";
  {
    TarFile tar(file);
    tar.add("a/b.png", std::string(513, 'x'));
    tar.add("empty.json", {});
    tar.close();
  }
  const std::string bytes = read_file(file);
  REQUIRE(bytes.size() == (1 + 2 + 1 + 2) * kBlock);
  CHECK(bytes.substr(0, 8) == std::string("a/b.png\0", 8));
  CHECK(bytes.substr(100, 24) == std::string("000644 \0"
                                             "000000 \0"
                                             "000000 \0",
                                             24));             // mode, user, group
  CHECK(bytes.substr(124, 24) == "00000001001 00000000000 ");  // size, time
  CHECK(bytes.substr(257, 8) == std::string("ustar\0"
                                            "00",
                                            8));
  CHECK(bytes.substr(kBlock, 513) == std::string(513, 'x'));
  CHECK(bytes.substr(3 * kBlock, 11) == std::string("empty.json\0", 11));
  CHECK(bytes.substr(4 * kBlock) == std::string(2 * kBlock, '\0'));
}

TEST_CASE("A tar file that is not closed is removed") {
  const TestFolder folder;
  const Path file = folder.path() / "a.tar";
  {
    TarFile tar(file);
    tar.add("b", "content");
    CHECK(std::filesystem::exists(file));
  }
  CHECK_FALSE(std::filesystem::exists(file));
}

TEST_CASE("A tar file replaces nothing") {
  const TestFolder folder;
  const Path file = folder.path() / "a.tar";
  write_file_atomically(file, "mine");
  CHECK(message_of<IoError>([&] { TarFile tar(file); }) == "cannot write " + file.string() + ": File exists");
  CHECK(read_file(file) == "mine");
}

}  // namespace tar_file_test
