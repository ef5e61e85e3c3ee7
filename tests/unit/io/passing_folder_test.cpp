#include "io/passing_folder.h"

#include <cstdlib>
#include <optional>

#include "support/catch.h"
#include "support/temporary_folder.h"

namespace passing_folder_test {

using namespace thermal;

namespace {

/// Folders for temporary files are made in this one, as long as it exists.
class OwnTemporaries {
 public:
  OwnTemporaries() { ::setenv("TMPDIR", folder.path().c_str(), 1); }
  ~OwnTemporaries() { ::unsetenv("TMPDIR"); }
  OwnTemporaries(const OwnTemporaries&) = delete;
  OwnTemporaries& operator=(const OwnTemporaries&) = delete;

  TemporaryFolder folder;
};

}  // namespace

TEST_CASE("A passing folder goes with its contents") {
  const OwnTemporaries temporaries;
  Path path;
  {
    const PassingFolder passing;
    path = passing.path();
    CHECK(std::filesystem::is_empty(path));
    write_file(path / "file", {});
  }
  CHECK_FALSE(std::filesystem::exists(path));
}

TEST_CASE("A passing folder removes what a killed run has left, and nothing that is in use or of others") {
  const OwnTemporaries temporaries;
  const Path left = temporaries.folder / ".veldt-passing-aaaaaa";
  const Path foreign = temporaries.folder / "veldt-demo";
  const Path kept = temporaries.folder / "elsewhere";
  for (const Path& folder : {left, foreign, kept}) make_folder(folder / "inside");
  std::filesystem::create_directory_symlink(kept, temporaries.folder / ".veldt-passing-link");
  const PassingFolder used;
  CHECK_FALSE(std::filesystem::exists(left));
  const PassingFolder second;
  CHECK(std::filesystem::exists(used.path()));
  CHECK(std::filesystem::exists(foreign / "inside"));
  CHECK(std::filesystem::exists(kept / "inside"));
}

}  // namespace passing_folder_test
