#include "io/assets.h"

#include <cstdlib>

#include "base/error.h"
#include "io/system/child_process.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace assets_test {

using namespace thermal;

namespace {

/// Sets an environment variable for its lifetime.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    ::setenv(name, value.c_str(), 1);
  }
  ~Environment() { before_.empty() ? ::unsetenv(name_) : ::setenv(name_, before_.c_str(), 1); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::string before_;
};

Path program_in(const TestFolder& folder, const std::string& name) {
  Path file = folder.file(name, "#!/bin/sh\n");
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  return file;
}

}  // namespace

TEST_CASE("A program is found on the path, in the first folder that has it") {
  const TestFolder first;
  const TestFolder second;
  const Path only_second = program_in(second, "render");
  const Path in_both = program_in(first, "plan");
  (void)program_in(second, "plan");
  (void)first.file("render", "a file that cannot be run");
  const Environment path("PATH", first.path().string() + ":" + second.path().string());
  CHECK(find_program("plan") == in_both);
  CHECK(find_program("render") == only_second);
  CHECK(find_program("blender").empty());
}

TEST_CASE("A program with a folder is that one or none") {
  const TestFolder folder;
  const Path program = program_in(folder, "blender");
  CHECK(find_program(program.string()) == program);
  CHECK(find_program(folder.path().string()).empty());
  CHECK(find_program((folder / "other").string()).empty());
}

TEST_CASE("The home is VELDT_HOME, if that is one") {
  const TestFolder folder;
  const Environment home("VELDT_HOME", folder.path().string());
  CHECK(message_of<IoError>([] { (void)Assets::find(); }) ==
        "VELDT_HOME = \"" + folder.path().string() + "\"; expected a folder with assets and blender_scripts");
  std::filesystem::create_directory(folder / "assets");
  std::filesystem::create_directory(folder / "blender_scripts");
  CHECK(Assets::find().home() == folder.path());
}

TEST_CASE("Without VELDT_HOME it is the checkout of the build") {
  const Environment home("VELDT_HOME", "");
  CHECK(std::filesystem::equivalent(Assets::find().home(), VELDT_SOURCE_DIR));
}

}  // namespace assets_test
