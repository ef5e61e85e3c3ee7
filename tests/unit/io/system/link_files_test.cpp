#include "base/error.h"
#include "io/system/files.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace link_files_test {

using namespace thermal;

TEST_CASE("A file gets a second location as requested") {
  const TestFolder folder;
  const Path file = folder.file("a", "what it holds");
  for (const Linking linking : {Linking::hard, Linking::symlink, Linking::copy}) {
    const Path as = folder / "new" / std::to_string(static_cast<int>(linking));
    CHECK(link_file(file, as, linking) == linking);
    CHECK(read_file(as) == "what it holds");
    CHECK(std::filesystem::is_symlink(as) == (linking == Linking::symlink));
    CHECK(std::filesystem::equivalent(file, as) == (linking != Linking::copy));
  }
}

TEST_CASE("The file itself is linked, not a symbolic link to it, which may be removed") {
  const TestFolder folder;
  const Path file = folder.file("a", "x");
  std::filesystem::create_symlink("a", folder / "link");
  for (const Linking linking : {Linking::hard, Linking::symlink, Linking::copy}) {
    const Path as = folder / "new" / std::to_string(static_cast<int>(linking));
    link_file(folder / "link", as, linking);
    std::filesystem::rename(folder / "link", folder / "gone");
    CHECK(read_file(as) == "x");
    std::filesystem::rename(folder / "gone", folder / "link");
  }
  CHECK(std::filesystem::read_symlink(folder / "new" / "1").is_absolute());
}

TEST_CASE("Without hard links the file is copied") {
  const TestFolder folder;
  const Path as = folder / "b";
  CHECK(link_file("/proc/version", as, Linking::hard) == Linking::copy);  // another file system
  CHECK(read_file(as) == read_file("/proc/version"));
}

TEST_CASE("A file that exists is neither replaced nor written to, nor what a link there leads to") {
  const TestFolder folder;
  const Path file = folder.file("a", "new");
  const Path old = folder.file("old", "old");
  std::filesystem::create_symlink("old", folder / "link");
  for (const Path& as : {old, folder / "link"}) {
    for (const Linking linking : {Linking::hard, Linking::symlink, Linking::copy}) {
      CHECK(message_of<IoError>([&] { link_file(file, as, linking); }) ==
            "cannot write " + as.string() + ": File exists");
      CHECK(read_file(old) == "old");
    }
  }
}

TEST_CASE("A missing file is an error") {
  const TestFolder folder;
  const std::string name = (folder / "none").string();
  CHECK(message_of<IoError>([&] { link_file(name, folder / "b", Linking::hard); }) ==
        "cannot read " + name + ": No such file or directory");
  CHECK_FALSE(std::filesystem::exists(folder / "b"));
}

}  // namespace link_files_test
