#include "io/system/sha256.h"
#include "support/catch.h"

namespace base64_test {

using namespace thermal;

TEST_CASE("Base64 of RFC 4648, section 10") {
  CHECK(base64_of("").empty());
  CHECK(base64_of("f") == "Zg==");
  CHECK(base64_of("fo") == "Zm8=");
  CHECK(base64_of("foo") == "Zm9v");
  CHECK(base64_of("foob") == "Zm9vYg==");
  CHECK(base64_of("fooba") == "Zm9vYmE=");
  CHECK(base64_of("foobar") == "Zm9vYmFy");
}

TEST_CASE("Base64 of bytes that are not text") {
  CHECK(base64_of(std::string("\xff\xfe\xfd\x00\x80", 5)) == "//79AIA=");
}

}  // namespace base64_test
