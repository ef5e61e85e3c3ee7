#include <fstream>

#include "base/error.h"
#include "io/system/files.h"
#include "io/system/temporary.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace output_file_test {

using namespace thermal;

namespace {

std::vector<std::string> lines_of(Spool& spool) {
  std::vector<std::string> lines;
  spool.read([&lines](std::string_view line) { lines.emplace_back(line); });
  return lines;
}

}  // namespace

TEST_CASE("A file has all that was added, and its checksum is that of the whole") {
  const TestFolder folder;
  OutputFile out(folder / "a.txt");
  std::string whole;
  for (int i = 0; i < 3000; ++i) {  // larger than any buffer
    const std::string piece = std::to_string(i) + "\n";
    out.add(piece);
    whole += piece;
  }
  CHECK(out.close() == sha256_of(whole));
  CHECK(read_file(folder / "a.txt") == whole);
}

TEST_CASE("A file that is not closed is removed") {
  const TestFolder folder;
  { OutputFile(folder / "a.txt").add("half"); }
  CHECK_FALSE(std::filesystem::exists(folder / "a.txt"));
}

TEST_CASE("A file is renamed to its place when it is closed, and not before") {
  const TestFolder folder;
  const Path place = folder.file("a.txt", "old");
  OutputFile out(folder / "a.txt.tmp");
  out.add("new");
  CHECK(read_file(place) == "old");
  CHECK(out.close_as(place) == sha256_of(std::string_view("new")));
  CHECK(read_file(place) == "new");
  CHECK_FALSE(std::filesystem::exists(folder / "a.txt.tmp"));
}

TEST_CASE("Nothing is written through a link") {
  const TestFolder folder;
  const Path other = folder.file("other.txt", "other");
  std::filesystem::create_symlink(other, folder / "a.txt");
  OutputFile out(folder / "a.txt");
  out.add("own");
  (void)out.close();
  CHECK(read_file(other) == "other");
  CHECK(read_file(folder / "a.txt") == "own");
}

TEST_CASE("A file that cannot be made is named, with the reason") {
  const TestFolder folder;
  const Path file = folder / "none/a.txt";
  CHECK(message_of<IoError>([&] { const OutputFile out(file); }) ==
        "cannot write " + file.string() + ": No such file or directory");
  OutputFile out(folder / "a.txt");
  CHECK(message_of<IoError>([&] { (void)out.close_as(file); }) ==
        "cannot rename to " + file.string() + ": No such file or directory");
}

TEST_CASE("Spooled lines come back in order, from memory and from a file that is then removed") {
  const TestFolder folder;
  for (const Path& file : {Path(), folder / "lines"}) {
    CAPTURE(file.string());
    Spool spool(file);
    for (const char* line : {"one", "", " three"}) spool.add(line);
    CHECK(lines_of(spool) == std::vector<std::string>{"one", "", " three"});
  }
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("Lines that are never read are removed with their file") {
  const TestFolder folder;
  {
    Spool spool(folder / "lines");
    spool.add("one");
    CHECK(std::filesystem::exists(folder / "lines"));
  }
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("Lines of a removed file cannot be read, and it is named") {
  const TestFolder folder;
  const Path file = folder / "lines";
  Spool spool(file);
  spool.add("one");
  std::filesystem::remove(file);
  CHECK(message_of<IoError>([&] { (void)lines_of(spool); }) ==
        "cannot read " + file.string() + ": it has disappeared");
}

}  // namespace output_file_test
