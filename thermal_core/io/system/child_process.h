#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/system/files.h"

namespace thermal {

/// The environment of every program that we start, as "NAME=value": the variables below where `ours` has them, and a
/// PATH of the system's own folders. Whatever else is set here, a Python's virtual environment above all, does not
/// reach those programs: Blender's Python would take its prefix from the first python3 on PATH.
/// A program that needs more, such as an LD_LIBRARY_PATH, is started by a script that sets it.
///
/// Handed down: HOME, TMPDIR; LANG, LANGUAGE, LC_*; OMP_NUM_THREADS, OPENBLAS_NUM_THREADS, MKL_NUM_THREADS, which
/// keep NumPy to a job's share of a machine.
/// Set, where the processor has AVX-512: NPY_DISABLE_CPU_FEATURES. NumPy's sin, arctan2, exp and power for AVX-512 differ
/// from the C library's in the last bit for 1 in 3 arguments, and which of the two are called depends on where an array
/// lies in memory: NumPy takes a strided array that ends where the result begins for one that overlaps it (1.24.2 and
/// 1.26.4). Without them the same config gives the same poses in every run and on every machine.
[[nodiscard]] std::vector<std::string> child_environment(std::span<const std::string> ours);

/// The same of this process's environment.
[[nodiscard]] std::vector<std::string> child_environment();

/// How a program ended.
struct ExitStatus {
  int code = 0;    ///< what it returned; meaningless if a signal ended it
  int signal = 0;  ///< the signal that ended it; 0 if none did

  /// "ended with exit code 1", "was killed by signal 9 (Killed)".
  [[nodiscard]] std::string in_words() const;
  /// Somebody, or the system out of memory, ended it: no crash, and it may go well another time.
  [[nodiscard]] bool is_killed() const noexcept;
};

/// What to say of a program that SIGKILL ended.
inline constexpr const char* kKilledHint = "unless someone killed it, the machine may have run out of memory";

/// A running program with a channel on which it reports line by line. Its environment is child_environment().
/// It has its own process group and dies with the thread that started it, even if that one is killed.
class ChildProcess {
 public:
  /// Descriptor on which the program finds the channel's writing end.
  static constexpr int kEventDescriptor = 3;

  /// Starts argv[0] with output and error appended to `log`. IoError if it cannot be started.
  ChildProcess(const std::vector<std::string>& argv, const Path& log);
  /// Kills the program's group if it still runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Next line of the channel, waiting up to this long. Nothing if none came; ended() says why.
  [[nodiscard]] std::optional<std::string> next_line(int timeout_ms);
  /// The channel is closed and all its lines are read.
  [[nodiscard]] bool ended() const noexcept { return closed_ && buffer_.empty(); }

  /// Waits for the end.
  ExitStatus wait();
  /// Asks the whole group to end; kills it after two seconds.
  void stop();

 private:
  [[nodiscard]] std::optional<std::string> take_line();
  [[nodiscard]] bool try_wait(int options);

  int process_ = -1;
  int events_ = -1;
  bool closed_ = false;
  std::string buffer_;
  std::optional<ExitStatus> status_;
};

/// How a program ended and what it wrote.
struct Output {
  ExitStatus status;
  std::string out;
  std::string error;

  /// The last line of `error` that is not empty, where programs say what they ended with; empty if there is none.
  [[nodiscard]] std::string last_words() const;
};
/// Runs a program to its end, in child_environment(), with `input` as its standard input. `take_event` receives each line
/// that it writes to ChildProcess::kEventDescriptor, which is open only if there is one. What the program has started
/// and left running is killed. IoError if it cannot start.
[[nodiscard]] Output run_program(const std::vector<std::string>& argv, std::string_view input = {},
                                 const std::function<void(const std::string& line)>& take_event = {});

/// Full path of a program: a path as given, or the first of that name on $PATH. Empty if no executable is found.
[[nodiscard]] Path find_program(const std::string& name);

}  // namespace thermal
