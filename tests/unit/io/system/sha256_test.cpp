#include "io/system/sha256.h"

#include <fstream>
#include <stdexcept>
#include <string>

#include "base/error.h"
#include "io/system/files.h"
#include "support/catch.h"
#include "support/test_folder.h"

namespace sha256_test {

using namespace thermal;

namespace {

/// The peak memory of this process since this was created, in kB (proc(5): VmHWM).
class PeakMemory {
 public:
  PeakMemory() {
    std::ofstream("/proc/self/clear_refs") << 5;
    before_kb_ = peak_kb();
  }
  [[nodiscard]] long grown_kb() const { return peak_kb() - before_kb_; }

 private:
  static long peak_kb() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
      long kb = 0;
      if (word == "VmHWM:" && status >> kb) return kb;
    }
    throw std::runtime_error("/proc/self/status says nothing of VmHWM");
  }
  long before_kb_ = 0;
};

}  // namespace

// Known answers: NIST's examples for FIPS 180-4.
TEST_CASE("SHA-256 gives the standard's answers") {
  CHECK(sha256_of("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sha256_of("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(sha256_of(std::string(1000000, 'a')) ==
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("A file's checksum is that of its content, and takes no memory for it") {
  const TestFolder folder;
  CHECK(sha256_of_file(folder.file("empty", "")) == sha256_of(""));
  CHECK(sha256_of_file(folder.file("abc", "abc")) == sha256_of("abc"));
  const std::string long_text = std::string(100'000, 'a') + "b";
  CHECK(sha256_of_file(folder.file("long", long_text)) == sha256_of(long_text));
  const Path large = folder.file("large", "");
  std::filesystem::resize_file(large, 300'000'000);
  const PeakMemory memory;
  CHECK(sha256_of_file(large) == "e8671610daa5dc152578d9bfe8e25346aa73fa600f908b235f55bf51d0eb5a05");
  CHECK(memory.grown_kb() < 10'000);
  CHECK_THROWS_AS(sha256_of_file(folder / "missing"), IoError);
  CHECK_THROWS_AS(sha256_of_file(folder.path()), IoError);
}

TEST_CASE("A checksum in pieces is that of the whole") {
  Sha256 sum;
  sum.add("a");
  sum.add("");
  sum.add("bc");
  CHECK(sum.hex() == sha256_of("abc"));
}

}  // namespace sha256_test
