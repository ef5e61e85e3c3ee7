#include <csignal>

#include "dataset/run/render_job.h"
#include "support/catch.h"
#include "support/test_folder.h"

namespace blender_failure_test {

using namespace thermal;

TEST_CASE("A reported failure is its message, its place and its hint, as far as there are any") {
  const Json event = {{"event", "error"},
                      {"kind", "internal"},
                      {"message", "ModuleNotFoundError: No module named 'numpy'"},
                      {"where", "blender_scripts/planner/noise.py:8"},
                      {"hint", "install it"}};
  CHECK(reported_failure(event).in_words() ==
        "ModuleNotFoundError: No module named 'numpy' (blender_scripts/planner/noise.py:8); install it");
  CHECK_FALSE(reported_failure(event).config);
  CHECK(reported_failure({{"message", "no mesh"}}).in_words() == "no mesh");
  CHECK(reported_failure({{"event", "error"}}).in_words() == "unknown reason");
  CHECK(reported_failure({{"kind", "config"}}).config);
}

TEST_CASE("A reported failure is one line whatever it holds, and of text") {
  CHECK(reported_failure({{"message", "one\ntwo\x1b[2J\n"}}).message == "one; two\\x1b[2J");
  CHECK_THROWS_AS(reported_failure({{"message", 7}}), Json::exception);
}

TEST_CASE("The last words of a log are its last three lines that say something") {
  const TestFolder folder;
  CHECK(last_error_line_in(folder / "none", 0).empty());
  CHECK(last_error_line_in(folder.file("empty", "\n \n\r\n"), 0).empty());
  CHECK(last_error_line_in(folder.file("one", "Error: no display"), 0) == "Error: no display");
  const Path log = folder.file("log", "a\nb\n\nc\n  \nd\n\nBlender quit\n");
  CHECK(last_error_line_in(log, 0) == "b / c / d");
  CHECK(last_error_line_in(log, 4) == "c / d");  // "a\nb\n" is an earlier Blender's
  CHECK(last_error_line_in(log, 1000).empty());
}

TEST_CASE("Last words are short and printable") {
  const TestFolder folder;
  CHECK(last_error_line_in(folder.file("long", std::string(1000, 'x')), 0) == std::string(200, 'x'));
  CHECK(last_error_line_in(folder.file("bytes", "a\x07\xff\n"), 0) == "a\\x07\\xff");
  const std::string far =
      "far away\n" + std::string(70000, '\n') + "near\n";  // only the last 65536 bytes are read
  CHECK(last_error_line_in(folder.file("far", far), 0) == "near");
}

TEST_CASE("An unreported end says how Blender ended, and what it printed unless it was killed") {
  const std::string doing = "building the scene";
  CHECK(unreported_end({.code = 1}, doing, "no display") ==
        "Blender ended with exit code 1 while building the scene: no display");
  CHECK(unreported_end({.code = 1}, doing, "") ==
        "Blender ended with exit code 1 while building the scene; it printed nothing");
  CHECK(unreported_end({}, doing, "Saved") == "Blender ended early while building the scene: Saved");
  CHECK(unreported_end({.signal = SIGSEGV}, doing, "Writing: crash.txt") ==
        "Blender was killed by signal 11 (Segmentation fault) while building the scene: Writing: crash.txt");
  CHECK(unreported_end({.signal = SIGTERM}, doing, "Fra:1") ==
        "Blender was killed by signal 15 (Terminated) while building the scene");
  CHECK(unreported_end({.signal = SIGKILL}, doing, "Fra:1") ==
        "Blender was killed by signal 9 (Killed) while building the scene; unless someone killed it, the "
        "machine may "
        "have run out of memory");
}

}  // namespace blender_failure_test
