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
/// PATH of the system's own folders. No other variable reaches those programs, above all not those of a Python virtual
/// environment: Blender's Python would take its prefix from the first python3 on PATH.
/// For a program that needs more, such as LD_LIBRARY_PATH, use a wrapper script.
///
/// Handed down: HOME, TMPDIR; LANG, LANGUAGE, LC_*; OMP_NUM_THREADS, OPENBLAS_NUM_THREADS, MKL_NUM_THREADS, which keep
/// NumPy to a job's share of a machine.
/// Set, where the processor has AVX-512: NPY_DISABLE_CPU_FEATURES. NumPy's sin, arctan2, exp and power for AVX-512
/// differ from the C library's in the last bit for 1 in 3 arguments, and which of the two are called depends on the
/// memory address of an array: NumPy mistakes a strided array that ends where the result begins for an overlapping one
/// (1.24.2 and 1.26.4). Without them the same config gives the same poses in every run and on every machine.
[[nodiscard]] std::vector<std::string> child_environment(std::span<const std::string> ours);

/// The same of this process's environment.
[[nodiscard]] std::vector<std::string> child_environment();

/// How a program ended.
struct ExitStatus {
  int code = 0;    ///< exit code; undefined if a signal ended it
  int signal = 0;  ///< the signal that ended it; 0 if none did

  /// "ended with exit code 1", "was killed by signal 9 (Killed)".
  [[nodiscard]] std::string in_words() const;
  /// Whether SIGKILL ended it, by a user or the system out of memory: not a crash, and a retry may succeed.
  [[nodiscard]] bool is_killed() const noexcept;
};

/// Explanation for a program ended by SIGKILL.
inline constexpr const char* kKilledHint = "unless someone killed it, the machine may have run out of memory";

/// A running program with a channel on which it reports line by line. Its environment is child_environment(). It has
/// its own process group and is killed when the thread that started it ends, however that ends.
class ChildProcess {
 public:
  /// Descriptor of the channel's writing end in the program.
  static constexpr int kEventDescriptor = 3;

  /// Starts argv[0] with output and error appended to `log`. IoError if it cannot be started.
  ChildProcess(const std::vector<std::string>& argv, const Path& log);
  /// Kills the program's group if it still runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Next line of the channel, waiting at most this long. Empty if none came; ended() says why.
  [[nodiscard]] std::optional<std::string> next_line(int timeout_ms);
  /// Whether the channel is closed and all its lines are read.
  [[nodiscard]] bool ended() const noexcept { return closed_ && buffer_.empty(); }

  /// Waits for the end.
  ExitStatus wait();
  /// Terminates the whole group; kills it after two seconds.
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

/// Exit status and output of a program.
struct Output {
  ExitStatus status;
  std::string out;
  std::string error;

  /// The last non-empty line of `error`, usually the error message; empty if there is none.
  [[nodiscard]] std::string last_error_line() const;
};
/// Runs a program to its end, in child_environment(), with `input` as its standard input. `take_event` receives each
/// line that it writes to ChildProcess::kEventDescriptor, which is open only with `take_event`. Its children that still
/// run are killed. IoError if it cannot start.
[[nodiscard]] Output run_program(const std::vector<std::string>& argv, std::string_view input = {},
                                 const std::function<void(const std::string& line)>& take_event = {});

/// Full path of a program: a path as given, or the first of that name on $PATH. Empty if no executable is found.
[[nodiscard]] Path find_program(const std::string& name);

}  // namespace thermal
