#include "raycast/engine_version.h"

#include <regex>

#include "support/catch.h"

namespace engine_version_test {

TEST_CASE("The engine has a version, and vectors") {
  CHECK(std::regex_match(thermal::engine_version(), std::regex(R"([34]\.\d+\.\d+, (4|8|16) rays at once)")));
}

}  // namespace engine_version_test
