#include <csignal>
#include <cstdlib>

#include <sys/wait.h>
#include <unistd.h>

#include "io/system/temporary.h"
#include "support/catch.h"
#include "support/patience.h"
#include "support/test_folder.h"

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

  TestFolder folder;
};

}  // namespace

TEST_CASE("A passing folder goes with its contents") {
  const OwnTemporaries temporaries;
  Path path;
  {
    const TemporaryFolder passing;
    path = passing.path();
    CHECK(std::filesystem::is_empty(path));
    write_file(path / "file", {});
  }
  CHECK_FALSE(std::filesystem::exists(path));
}

TEST_CASE("A passing folder goes with its contents if its process is interrupted or killed") {
  const OwnTemporaries temporaries;
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    const int process = ::fork();
    if (process == 0) {
      const TemporaryFolder passing;
      make_folder(passing.path() / "deep");
      write_file(passing.path() / "deep" / "file", {});
      ::signal(signal, SIG_DFL);
      ::raise(signal);
    }
    int status = 0;
    REQUIRE(::waitpid(process, &status, 0) == process);
    CHECK(WTERMSIG(status) == signal);
    CHECK(wait_until([&] { return std::filesystem::is_empty(temporaries.folder.path()); }));
  }
}

TEST_CASE("A passing folder removes what a killed run has left, and nothing that is in use or of others") {
  const OwnTemporaries temporaries;
  const Path left = temporaries.folder / ".veldt-passing-aaaaaa";
  const Path foreign = temporaries.folder / "veldt-demo";
  const Path kept = temporaries.folder / "elsewhere";
  for (const Path& folder : {left, foreign, kept}) make_folder(folder / "inside");
  std::filesystem::create_directory_symlink(kept, temporaries.folder / ".veldt-passing-link");
  const TemporaryFolder used;
  CHECK_FALSE(std::filesystem::exists(left));
  const TemporaryFolder second;
  CHECK(std::filesystem::exists(used.path()));
  CHECK(std::filesystem::exists(foreign / "inside"));
  CHECK(std::filesystem::exists(kept / "inside"));
}

}  // namespace passing_folder_test
