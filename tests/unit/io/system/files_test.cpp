#include "io/system/files.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <iterator>
#include <thread>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "io/system/locks.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace files_test {

using namespace thermal;

namespace {

std::ptrdiff_t entries_of(const Path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

/// Another process that holds a folder's lock until it is killed.
class Holder {
 public:
  explicit Holder(const Path& folder) {
    int ready[2] = {};
    REQUIRE(::pipe(ready) == 0);
    process_ = ::fork();
    if (process_ == 0) {
      const FolderLock lock(folder);
      (void)!::write(ready[1], "x", 1);
      ::pause();
      ::_exit(0);
    }
    char byte = 0;
    REQUIRE(::read(ready[0], &byte, 1) == 1);
    ::close(ready[0]);
    ::close(ready[1]);
  }
  ~Holder() { kill(); }
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;

  void kill() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = 0;
  }

 private:
  pid_t process_ = 0;
};

}  // namespace

TEST_CASE("A file is read completely, whatever it contains") {
  const TestFolder folder;
  const std::string content("a\0b\r\n\xFF", 6);
  CHECK(read_file(folder.file("data", content)) == content);
  CHECK(read_file(folder.file("empty", "")).empty());
}

TEST_CASE("An unreadable file is named, with the system's reason") {
  const TestFolder folder;
  const Path missing = folder / "missing.json";
  CHECK(message_of<IoError>([&] { (void)read_file(missing); }) ==
        "cannot read " + missing.string() + ": No such file or directory");
  CHECK(message_of<IoError>([&] { (void)read_file(folder.path()); }) ==
        "cannot read " + folder.path().string() + ": Is a directory");
}

TEST_CASE("Writing atomically leaves the file, and nothing beside it") {
  const TestFolder folder;
  const Path file = folder.file("data.json", "a longer text that was there before");
  write_file_atomically(file, "new");
  CHECK(read_file(file) == "new");
  CHECK(entries_of(folder.path()) == 1);
}

TEST_CASE("An unwritable file is named, and the old file stays") {
  const TestFolder folder;
  const Path nowhere = folder / "no/folder/data.json";
  CHECK_THAT(message_of<IoError>([&] { write_file_atomically(nowhere, "x"); }),
             StartsWith("cannot write " + nowhere.string()) && EndsWith(": No such file or directory"));
  std::filesystem::create_directories(folder / "taken/by");
  const Path taken = folder / "taken";
  CHECK(message_of<IoError>([&] { write_file_atomically(taken, "x"); }) ==
        "cannot rename to " + taken.string() + ": Is a directory");
  CHECK(std::filesystem::is_directory(taken / "by"));
}

TEST_CASE("A full disk is a TryAgainError") {
  CHECK(message_of<TryAgainError>([] { fail_at("write", "a.png", ENOSPC); }) ==
        "cannot write a.png: No space left on device");
  CHECK(message_of<TryAgainError>([] { fail_at("write", "a.png", EDQUOT); }) ==
        "cannot write a.png: Disk quota exceeded");
  CHECK(message_of<IoError>([] { fail_at("write", "a.png", EROFS); }) ==
        "cannot write a.png: Read-only file system");
}

TEST_CASE("Devices and folders are not read: some never end") {
  const TestFolder folder;
  CHECK(message_of<IoError>([] { (void)read_file("/dev/zero"); }) ==
        "cannot read /dev/zero: it is a device; expected a file or a pipe");
  CHECK(message_of<IoError>([&] { (void)read_file(folder.path()); }) ==
        "cannot read " + folder.path().string() + ": Is a directory");
}

TEST_CASE("A pipe is read to its end; without a writer it is empty, and nothing waits") {
  const TestFolder folder;
  const Path pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(read_file(pipe).empty());
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  REQUIRE(::write(ends[1], "late", 4) == 4);
  ::close(ends[1]);
  CHECK(read_file("/dev/fd/" + std::to_string(ends[0])) == "late");
  ::close(ends[0]);
}

TEST_CASE("A file is read up to 1 GiB") {
  const TestFolder folder;
  const Path file = folder.file("hole", "");
  std::filesystem::resize_file(file, (std::uintmax_t{1} << 30U) + 1);
  CHECK(message_of<IoError>([&] { (void)read_file(file); }) ==
        "cannot read " + file.string() + ": more than 1073741824 bytes; expected at most 1 GiB");
}

TEST_CASE("A copy has the content, and replaces nothing") {
  const TestFolder folder;
  const Path file = folder.file("a", std::string(200000, 'x'));
  copy_content(file, folder / "b");
  CHECK(read_file(folder / "b") == read_file(file));
  CHECK(message_of<IoError>([&] { copy_content(file, folder / "b"); }) ==
        "cannot write " + (folder / "b").string() + ": File exists");
}

TEST_CASE("A new file replaces none") {
  const TestFolder folder;
  const Path file = folder.file("a", "old");
  CHECK(message_of<IoError>([&] { write_file(file, {}); }) ==
        "cannot write " + file.string() + ": File exists");
  CHECK(read_file(file) == "old");
}

TEST_CASE("Folders are created with their parents; a file in the way is an error") {
  const TestFolder folder;
  make_folder(folder / "a/b/c");
  make_folder(folder / "a/b/c");
  CHECK(std::filesystem::is_directory(folder / "a/b/c"));
  (void)folder.file("file", "");
  CHECK(message_of<IoError>([&] { make_folder(folder / "file/below"); }) ==
        "cannot make folder " + (folder / "file/below").string() + ": Not a directory");
}

TEST_CASE("One process at a time locks a folder") {
  const TestFolder folder;
  const Path data = folder / "data";
  Holder holder(data);
  CHECK(message_of<TryAgainError>([&] { const FolderLock second(data); }) ==
        data.string() + " is in use by another run of veldt; try again when that one has ended");
  holder.kill();
  CHECK_NOTHROW(FolderLock(data));  // a terminated process holds nothing
}

TEST_CASE("A folder is free again when its lock ends") {
  const TestFolder folder;
  { const FolderLock first(folder / "data"); }
  CHECK_NOTHROW(FolderLock(folder / "data"));
}

TEST_CASE("Runs share a folder as long as their places differ") {
  const TestFolder folder;
  const std::string in_use =
      folder.path().string() + " is in use by another run of veldt; try again when that one has ended";
  const FolderLock first(folder.path(), {0, 2});
  const FolderLock second(folder.path(), {1, 3});
  const FolderLock without_places(folder.path(), {});
  CHECK(message_of<TryAgainError>([&] { const FolderLock third(folder.path(), {4, 3}); }) == in_use);
  CHECK_NOTHROW(FolderLock(folder.path(), {4}));
  CHECK(message_of<TryAgainError>([&] { const FolderLock all(folder.path()); }) == in_use);
}

TEST_CASE("A folder locked by one run has no places for others, nor for a run without places") {
  const TestFolder folder;
  const FolderLock all(folder.path());
  CHECK_THROWS_AS(FolderLock(folder.path(), {7}), TryAgainError);
  CHECK_THROWS_AS(FolderLock(folder.path(), {}), TryAgainError);
}

TEST_CASE("A run without places prevents others from locking the whole folder") {
  const TestFolder folder;
  const FolderLock without_places(folder.path(), {});
  CHECK_THROWS_AS(FolderLock(folder.path()), TryAgainError);
}

TEST_CASE("Runs that share a folder take turns, and an exception ends a turn") {
  const TestFolder folder;
  const FolderLock first(folder.path(), {0});
  const FolderLock second(folder.path(), {1});
  std::atomic<int> value = 0;  // a lock for processes: C++ knows of no order that it gives to threads
  const auto count_to = [&value](const FolderLock& lock) {
    for (int k = 0; k < 500; ++k)
      lock.in_turn([&value] { value = value + 1; });  // loses counts without turns
  };
  std::thread other([&] { count_to(second); });
  count_to(first);
  other.join();
  CHECK(value == 1000);
  CHECK_THROWS_AS(first.in_turn([] { throw DataError("no"); }), DataError);
  second.in_turn([&value] { value = 0; });
  CHECK(value == 0);
}

TEST_CASE("A file system has some free space, and a missing place reports none") {
  CHECK(free_bytes("/") >= 0);
  CHECK(free_bytes("/proc") == 0);
  CHECK(message_of<IoError>([] { (void)free_bytes("/nowhere"); }) ==
        "cannot get the free disk space of /nowhere: No such file or directory");
}

TEST_CASE("Only regular files are read: anything that would block or never end is refused") {
  const TestFolder folder;
  const auto fault_of = [](const Path& file) { return message_of<IoError>([&] { check_is_file(file); }); };
  write_file(folder / "file", {});
  std::filesystem::create_symlink("file", folder / "link");
  CHECK_NOTHROW(check_is_file(folder / "file"));
  CHECK_NOTHROW(check_is_file(folder / "link"));
  const std::string name = "cannot read " + (folder / "x").string() + ": ";
  CHECK(fault_of(folder / "x") == name + "no such file");
  CHECK(fault_of(folder / "file/x") == "cannot read " + (folder / "file/x").string() + ": no such file");
  std::filesystem::create_symlink("x", folder / "x");
  CHECK(fault_of(folder / "x") == name + "Too many levels of symbolic links");
  std::filesystem::remove(folder / "x");
  make_folder(folder / "x");
  CHECK(fault_of(folder / "x") == name + "it is a folder; expected a file");
  std::filesystem::remove(folder / "x");
  REQUIRE(::mkfifo((folder / "x").c_str(), 0600) == 0);
  CHECK(fault_of(folder / "x") == name + "it is a pipe or a device; expected a file");
  CHECK(fault_of("/dev/zero") == "cannot read /dev/zero: it is a pipe or a device; expected a file");
}

TEST_CASE("Writing a file replaces links of either name, and their targets stay unchanged") {
  const TestFolder folder;
  write_file_atomically(folder / "kept", "kept");
  for (const char* name : {"file", "file.tmp"}) {
    std::filesystem::create_symlink("kept", folder / name);
    write_file_atomically(folder / "file", "new");
    CHECK(read_file(folder / "file") == "new");
    CHECK(read_file(folder / "kept") == "kept");
    CHECK_FALSE(std::filesystem::is_symlink(folder / "file"));
  }
  std::filesystem::create_symlink("nowhere", folder / "file.tmp");
  write_file_atomically(folder / "file", "newer");
  CHECK_FALSE(std::filesystem::exists(folder / "nowhere"));
}

TEST_CASE("No partial file is left if a file cannot be written") {
  const TestFolder folder;
  make_folder(folder / "file/in the way");
  CHECK(message_of<IoError>([&] { write_file_atomically(folder / "file", "new"); }) ==
        "cannot rename to " + (folder / "file").string() + ": Is a directory");
  CHECK(entries_of(folder.path()) == 1);
}

TEST_CASE("A folder is put elsewhere as a whole, and what was there is gone") {
  const TestFolder folder;
  make_folder(folder / "whole/ir8");
  make_folder(folder / "place/old");
  write_file_atomically(folder / "whole/ir8/0.png", "picture");
  write_file_atomically(folder / "whole/clip.json", "record");
  put_folder(folder / "whole", folder / "place", "clip.json");
  CHECK(read_file(folder / "place/ir8/0.png") == "picture");
  CHECK(read_file(folder / "place/clip.json") == "record");
  CHECK(entries_of(folder / "place") == 2);
  CHECK(entries_of(folder.path()) == 1);
}

TEST_CASE("The last file of a folder that is put elsewhere is there with its whole content, or not at all") {
  const TestFolder folder;
  const std::string record(std::size_t{8} << 20U, 'x');
  const Path place = folder / "place/clip.json";
  std::atomic<bool> done = false;
  std::atomic<int> whole = 0;
  std::atomic<int> partial = 0;
  std::thread reader([&] {
    std::error_code error;
    while (!done || whole == 0)
      if (const auto bytes = std::filesystem::file_size(place, error); !error)
        ++(bytes == record.size() ? whole : partial);
  });
  for (int k = 0; k < 4; ++k) {
    make_folder(folder / "whole");
    write_file(folder / "whole/clip.json", std::as_bytes(std::span(record)));
    put_folder(folder / "whole", folder / "place", "clip.json");
  }
  done = true;
  reader.join();
  CHECK(partial == 0);
}

TEST_CASE("Of a folder that cannot be put elsewhere, nothing is left there, and nothing is lost") {
  const TestFolder folder;
  make_folder(folder / "whole/ir8");
  write_file_atomically(folder / "whole/ir8/0.png", "picture");
  CHECK(message_of<IoError>([&] { put_folder(folder / "whole", folder / "place", "clip.json"); }) ==
        "cannot read " + (folder / "whole/clip.json").string() + ": No such file or directory");
  CHECK_FALSE(std::filesystem::exists(folder / "place"));
  CHECK(read_file(folder / "whole/ir8/0.png") == "picture");
}

TEST_CASE("A lock that is a link to elsewhere is refused") {
  const TestFolder folder;
  std::filesystem::create_symlink("elsewhere", folder / ".lock");
  CHECK(
      message_of<IoError>([&] { const FolderLock lock(folder.path()); }) ==
      (folder / ".lock").string() +
          " = a link to elsewhere; expected a path that is not a link; nothing elsewhere is read or written");
  CHECK_FALSE(std::filesystem::exists(folder / "elsewhere"));
}

}  // namespace files_test
