#include "analysis/compare/frame_source.h"
#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace frame_names_test {

using namespace thermal;

TEST_CASE("Fields of a name are read") {
  const FrameNames names("{_}_{altitude_m}_{look_angle_deg}_{_}_{_}", "--names");
  const auto pose = names.read("1_100_30_0_02314");
  REQUIRE(pose);
  CHECK(pose->altitude_m == 100);
  CHECK(pose->look_angle_deg == 30);
  const auto alone = FrameNames("h{altitude_m}m", "--names").read("h61.5m");
  REQUIRE(alone);
  CHECK(alone->altitude_m == 61.5);
  CHECK_FALSE(alone->look_angle_deg);
}

TEST_CASE("Names that do not match") {
  const FrameNames names("f{_}_{altitude_m}m", "--names");
  for (const char* name : {"", "f1_50", "x1_50m", "f_50m", "f1_m", "f1_highm", "f1_nanm", "f1_infm"}) {
    INFO(name);
    CHECK_FALSE(names.read(name));
  }
}

TEST_CASE("Patterns that mean nothing") {
  for (const char* pattern :
       {"", "x", "{_}", "{altitude}", "{altitude_m", "{altitude_m}{_}", "{_}{altitude_m}"}) {
    CHECK(message_of<ConfigError>([&] { FrameNames(pattern, "--names"); }) ==
          std::string("--names = ") + pattern +
              "; expected text and the fields {altitude_m}, {look_angle_deg} and {_}, one of the first two "
              "among them, "
              "with text between fields");
  }
}

}  // namespace frame_names_test
