#include <cstdlib>

#include "io/system/child_process.h"
#include "support/catch.h"
#include "support/test_folder.h"

namespace child_environment_test {

using namespace thermal;

namespace {

const std::string kSystemPath = "PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin";

/// What programs get whatever is set here.
std::vector<std::string> fixed() {
  std::vector<std::string> variables = {kSystemPath};
  if (read_file("/proc/cpuinfo").find(" avx512dq") != std::string::npos)
    variables.emplace_back("NPY_DISABLE_CPU_FEATURES=AVX512F AVX512_SKX");
  return variables;
}

std::vector<std::string> shell(const std::string& script) { return {"/bin/sh", "-c", script}; }

/// Sets a variable that no test and no program depends on, for as long as it lives.
class Variable {
 public:
  explicit Variable(const char* name) : name_(name) { ::setenv(name, "there", 1); }
  ~Variable() { ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

}  // namespace

TEST_CASE("Programs get the variables of the list, in order, and the system's PATH") {
  const std::vector<std::string> ours = {"LC_ALL=C.UTF-8",         "HOME=/srv/a b",    "LANG=",
                                         "TMPDIR=/scratch",        "LANGUAGE=en",      "OMP_NUM_THREADS=4",
                                         "OPENBLAS_NUM_THREADS=2", "MKL_NUM_THREADS=1"};
  std::vector<std::string> expected = fixed();
  expected.insert(expected.end(), ours.begin(), ours.end());
  CHECK(child_environment(ours) == expected);
}

TEST_CASE("No other variable reaches them, near misses included") {
  const std::vector<std::string> ours = {"PATH=/venv/bin:/usr/bin",
                                         "VIRTUAL_ENV=/venv",
                                         "PYTHONHOME=/venv",
                                         "PYTHONPATH=/junk",
                                         "PYTHONSTARTUP=/a.py",
                                         "CONDA_PREFIX=/conda",
                                         "PYENV_ROOT=/pyenv",
                                         "PYENV_VERSION=3.9",
                                         "LD_LIBRARY_PATH=/conda",
                                         "LD_PRELOAD=/a.so",
                                         "BLENDER_USER_SCRIPTS=/s",
                                         "OCIO=/a.ocio",
                                         "VELDT_PYTHON=/p",
                                         "HOMEPAGE=/x",
                                         "LC=a",
                                         "",
                                         "=C:=C:\\",
                                         "XLANG=a"};
  CHECK(child_environment(ours) == fixed());
  CHECK(child_environment({}) == fixed());
}

TEST_CASE("Both ways to start a program give it that environment") {
  const Variable handed_down("LC_VELDT_TEST");
  const Variable kept("PYTHON_VELDT_TEST");
  const std::string script = "/usr/bin/env | grep -E '^PATH=|VELDT_TEST='";
  const std::string expected = kSystemPath + "\nLC_VELDT_TEST=there\n";
  CHECK(run_program(shell(script)).out == expected);
  const TestFolder folder;
  ChildProcess child(shell(script), folder / "log");
  CHECK(child.wait().code == 0);
  CHECK(read_file(folder / "log") == expected);
}

}  // namespace child_environment_test
