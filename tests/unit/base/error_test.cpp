#include "base/error.h"

#include <type_traits>

#include "support/catch.h"
#include "support/message_of.h"

namespace error_test {

using namespace thermal;

TEST_CASE("A message states where, what, in which unit, and what was expected") {
  CHECK(fault("camera.height_m", "-3", "m", "at least 0 m") ==
        "camera.height_m = -3 m; expected at least 0 m");
}

TEST_CASE("A message without a unit has no gap for it") {
  CHECK(fault("--shard", "3/2", "", "I/N with I below N") == "--shard = 3/2; expected I/N with I below N");
}

TEST_CASE("Faults of one file are lines of one message, and no faults are no message") {
  CHECK_NOTHROW(throw_faults({}, "a.json"));
  CHECK(message_of<ConfigError>([] {
          throw_faults({"x = 1; expected 2", "y is missing"}, "a.json");
        }) == "a.json: x = 1; expected 2\na.json: y is missing");
}

TEST_CASE("Every user-facing fault is an Error, and its kinds are distinct") {
  STATIC_REQUIRE(std::is_base_of_v<Error, ConfigError>);
  STATIC_REQUIRE(std::is_base_of_v<Error, DataError>);
  STATIC_REQUIRE(std::is_base_of_v<Error, IoError>);
  STATIC_REQUIRE(std::is_base_of_v<Error, TryAgainError>);
  STATIC_REQUIRE(std::is_base_of_v<Error, Cancelled>);
  // The exit code depends on the kind: a full disk (75) must not be caught as a broken file (1).
  STATIC_REQUIRE_FALSE(std::is_base_of_v<IoError, TryAgainError>);
  CHECK(std::string(Cancelled().what()) == "stopped on request");
}

}  // namespace error_test
