#include "base/text.h"
#include "support/catch.h"

namespace printable_test {

using namespace thermal;

TEST_CASE("Printable text is unchanged") {
  for (const char* text : {"", "one/000001.exr", "~", "\u00a0", "\u00b5m", "\u07ff", "\u0800", "\ud7ff",
                           "\ue000", "\uffff", "\U00010000", "\U0010ffff"})
    CHECK(printable(text) == text);
}

TEST_CASE("Control characters are escaped, and line breaks removed") {
  CHECK(printable("a\x1b[2Jb\tc\rd\x7f") == "a\\x1b[2Jb\\x09c\\x0dd\\x7f");
  CHECK(printable(std::string_view("a\0b", 3)) == "a\\x00b");
  CHECK(printable("damaged\nat its end\n\n") == "damaged; at its end");
  CHECK(printable("\xc2\x9b") == "\\xc2\\x9b");  // U+009B starts terminal commands
}

TEST_CASE("Bytes that are not UTF-8 are escaped one by one") {
  CHECK(printable("\xff") == "\\xff");
  CHECK(printable("a\x80z") == "a\\x80z");
  CHECK(printable("\xc0\xaf") == "\\xc0\\xaf");                    // overlong
  CHECK(printable("\xe0\x9f\xbf") == "\\xe0\\x9f\\xbf");           // overlong
  CHECK(printable("\xed\xa0\x80") == "\\xed\\xa0\\x80");           // a surrogate
  CHECK(printable("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");  // past the last
  CHECK(printable("\xe2\x82") == "\\xe2\\x82");                    // cut short
  CHECK(printable("\xf0\x9f\x98(") == "\\xf0\\x9f\\x98(");
}

}  // namespace printable_test
