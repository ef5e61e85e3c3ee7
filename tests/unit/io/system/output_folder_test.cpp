#include <fmt/format.h>

#include "base/error.h"
#include "io/system/files.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace output_folder_test {

using namespace thermal;

namespace {

void put(const Path& file, const std::string& content) {
  make_folder(file.parent_path());
  write_file(file, std::as_bytes(std::span(content)));
}

}  // namespace

TEST_CASE("A fresh folder is empty, whatever existed before") {
  const TestFolder folder;
  make_fresh_folder(folder / "clips/a.part");
  CHECK(std::filesystem::is_empty(folder / "clips/a.part"));
  put(folder / "clips/a.part/ir8/0.png", "old");
  make_fresh_folder(folder / "clips/a.part");
  CHECK(std::filesystem::is_empty(folder / "clips/a.part"));
  std::filesystem::remove(folder / "clips/a.part");
  put(folder / "clips/a.part", "a file");
  make_fresh_folder(folder / "clips/a.part");
  CHECK(std::filesystem::is_empty(folder / "clips/a.part"));
}

TEST_CASE("A folder of our own keeps its files, and has no links in it") {
  const TestFolder folder;
  put(folder / "out/passes/0.exr", "old");
  make_own_folder(folder / "out/passes");
  CHECK(read_file(folder / "out/passes/0.exr") == "old");
  put(folder / "elsewhere/kept", "kept");
  std::filesystem::create_symlink(folder / "elsewhere/kept", folder / "out/passes/1.exr");
  std::filesystem::create_directory_symlink(folder / "elsewhere", folder / "out/preview");
  for (const auto& [made, link] :
       {std::pair("out/passes", "out/passes/1.exr"), std::pair("out/preview", "out/preview")}) {
    CHECK_THAT(message_of<IoError>([&] { make_own_folder(folder / made); }),
               StartsWith((folder / link).string() + " = a link to " + (folder / "elsewhere").string()));
  }
}

TEST_CASE("A fresh folder replaces a link, and the link's target stays") {
  const TestFolder folder;
  put(folder / "elsewhere/kept", "kept");
  make_folder(folder / "clips");
  std::filesystem::create_directory_symlink(folder / "elsewhere", folder / "clips/a.part");
  make_fresh_folder(folder / "clips/a.part");
  CHECK(std::filesystem::is_empty(folder / "clips/a.part"));
  CHECK_FALSE(std::filesystem::is_symlink(folder / "clips/a.part"));
  CHECK(read_file(folder / "elsewhere/kept") == "kept");
}

TEST_CASE("A fresh folder is not created where its parent leads elsewhere") {
  const TestFolder folder;
  make_folder(folder / "elsewhere");
  std::filesystem::create_directory_symlink(folder / "elsewhere", folder / "clips");
  CHECK(message_of<IoError>([&] { make_fresh_folder(folder / "clips/a.part"); }) ==
        fmt::format(
            "{} = a link to {}; expected a path that is not a link; nothing elsewhere is read or written",
            (folder / "clips").string(), (folder / "elsewhere").string()));
  CHECK(std::filesystem::is_empty(folder / "elsewhere"));
}

TEST_CASE("A complete folder replaces nothing, a folder, or a link") {
  const TestFolder folder;
  put(folder / "elsewhere/kept", "kept");
  if (GENERATE(true, false)) put(folder / "a/old", "old");
  for (const bool link : {false, true}) {
    if (link) {
      std::filesystem::remove_all(folder / "a");
      std::filesystem::create_directory_symlink(folder / "elsewhere", folder / "a");
    }
    put(folder / "a.part/new", "new");
    replace_folder(folder / "a.part", folder / "a");
    CHECK(read_file(folder / "a/new") == "new");
    CHECK_FALSE(std::filesystem::exists(folder / "a/old"));
    CHECK_FALSE(std::filesystem::is_symlink(folder / "a"));
    CHECK_FALSE(std::filesystem::exists(std::filesystem::symlink_status(folder / "a.part")));
  }
  CHECK(read_file(folder / "elsewhere/kept") == "kept");
}

TEST_CASE("A missing folder cannot be renamed") {
  const TestFolder folder;
  CHECK(message_of<IoError>([&] { replace_folder(folder / "a.part", folder / "a"); }) ==
        fmt::format("cannot rename to {}: No such file or directory", (folder / "a").string()));
}

TEST_CASE("What cannot be removed is named, with the reason") {
  const TestFolder folder;
  put(folder / "a/ir8/0.png", "old");
  CHECK_FALSE(sweep_folder(folder / "a").has_value());
  CHECK_FALSE(std::filesystem::exists(folder / "a"));
  CHECK_FALSE(sweep_folder(folder / "a").has_value());
  const Path impossible = folder / std::string(300, 'x');
  const auto left_over = sweep_folder(impossible);
  REQUIRE(left_over.has_value());
  CHECK(left_over->location == impossible);
  CHECK(left_over->reason == "File name too long");
}

}  // namespace output_folder_test
