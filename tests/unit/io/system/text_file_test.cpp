#include "io/system/text_file.h"

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace text_file_test {

using namespace thermal;

TEST_CASE("A text file is read without its byte-order mark, and otherwise as it is") {
  const TestFolder folder;
  CHECK(read_text_file(folder.file("a", "\xEF\xBB\xBFx\r\ny")) == "x\r\ny");
  CHECK(read_text_file(folder.file("b", "x\xEF\xBB\xBF")) == "x\xEF\xBB\xBF");
  CHECK(read_text_file(folder.file("c", "")).empty());
}

TEST_CASE("A text file of more than the limit is not read") {
  const TestFolder folder;
  const Path file = folder.file("large.csv", std::string(4097, 'x'));
  CHECK(read_text_file(file, 4097).size() == 4097);
  CHECK(message_of<IoError>([&] { (void)read_text_file(file, 4096); }) ==
        file.string() + " = 4097 bytes; expected at most 4096 bytes (0 MiB)");
  // A file of /proc says that it has 0 bytes.
  CHECK(message_of<IoError>([] {
          (void)read_text_file("/proc/self/status", 16);
        }).ends_with(" bytes; expected at most 16 bytes (0 MiB)"));
}

TEST_CASE("What is not a regular file is not read") {
  const TestFolder folder;
  const auto fault_of = [](const Path& file) {
    return message_of<IoError>([&] { (void)read_text_file(file); });
  };
  CHECK(fault_of("/dev/zero") == "cannot read /dev/zero: it is a pipe or a device; expected a file");
  CHECK(fault_of(folder.path()) ==
        "cannot read " + folder.path().string() + ": it is a folder; expected a file");
  CHECK(fault_of("/nowhere/t") == "cannot read /nowhere/t: no such file");
}

}  // namespace text_file_test
