#include "io/system/child_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <iterator>
#include <sstream>
#include <string_view>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"

namespace thermal {
namespace {

constexpr const char* kPath = "PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin";

constexpr const char* kReproducibleNumpy = "NPY_DISABLE_CPU_FEATURES=AVX512F AVX512_SKX";

constexpr std::array<std::string_view, 7> kHandedDown = {
    "HOME", "TMPDIR", "LANG", "LANGUAGE", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"};

/// Whether NumPy may use AVX-512. Disabling features that a processor lacks would make NumPy warn.
bool has_avx512() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx512dq") != 0;  // implies AVX512F
#else
  return false;
#endif
}

bool is_handed_down(std::string_view variable) {
  const std::string_view name = variable.substr(0, variable.find('='));
  return name.starts_with("LC_") || std::ranges::find(kHandedDown, name) != kHandedDown.end();
}

}  // namespace

std::vector<std::string> child_environment(std::span<const std::string> ours) {
  std::vector<std::string> theirs = {kPath};
  if (has_avx512()) theirs.emplace_back(kReproducibleNumpy);
  std::ranges::copy_if(ours, std::back_inserter(theirs), is_handed_down);
  return theirs;
}

std::vector<std::string> child_environment() {
  std::vector<std::string> ours;
  for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable)
    ours.emplace_back(*variable);
  return child_environment(ours);
}

namespace {

constexpr int kCannotRun = 127;

[[noreturn]] void fail(const std::string& doing) {
  throw IoError(fmt::format("cannot {}: {}", doing, std::strerror(errno)));
}

std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> result;
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): execve takes char* const* and writes nothing
  for (const std::string& text : texts) result.push_back(const_cast<char*>(text.c_str()));
  result.push_back(nullptr);
  return result;
}

/// Becomes the program. Between fork and exec: nothing but system calls that are safe there.
[[noreturn]] void become(char* const* argv, char* const* environment, int in, int out, int error, int events,
                         int parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kCannotRun);  // the parent ended before the line above
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(error, STDERR_FILENO);
  if (events >= 0) ::dup2(events, ChildProcess::kEventDescriptor);
  const int first_foreign = events >= 0 ? ChildProcess::kEventDescriptor + 1 : STDERR_FILENO + 1;
  ::close_range(static_cast<unsigned>(first_foreign), ~0U, 0);  // descriptors that this process inherited
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::signal(SIGPIPE, SIG_DFL);
  ::execve(argv[0], argv, environment);
  ::_exit(kCannotRun);
}

/// Moves a descriptor above those with a fixed meaning in the child, so that no dup2 there overwrites it; negative on
/// failure.
int moved_up(int descriptor) {
  constexpr int kLowest = 10;
  const int high = ::fcntl(descriptor, F_DUPFD_CLOEXEC, kLowest);
  ::close(descriptor);
  return high;
}

struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("make a pipe");
    read = moved_up(ends[0]);
    write = moved_up(ends[1]);
    if (read < 0 || write < 0) fail("make a pipe");
  }
  int read;
  int write;
};

int open_high(const char* file, int flags) {
  const int low = ::open(file, flags | O_CLOEXEC, 0666);
  if (low < 0) fail(fmt::format("open {}", file));
  return moved_up(low);
}

/// A descriptor for reading this text, of any length, without a temporary file.
int open_text(std::string_view text) {
  const int low = ::memfd_create("input", MFD_CLOEXEC);
  if (low < 0) fail("make a file in memory");
  for (std::string_view rest = text; !rest.empty();) {
    const ssize_t bytes = ::write(low, rest.data(), rest.size());
    if (bytes < 0 && errno != EINTR) fail("write a file in memory");
    rest.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(bytes, 0)));
  }
  ::lseek(low, 0, SEEK_SET);
  return moved_up(low);
}

/// Takes the first line out of a text; nothing if no line is complete.
std::optional<std::string> first_line(std::string& text) {
  const std::size_t end = text.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = text.substr(0, end);
  text.erase(0, end + 1);
  return line;
}

constexpr std::size_t kStreams = 3;  // output, error, events

/// Kills the children of a program that has ended: they may hold the pipes open for ever. Options: of waitid().
void end_group_of(int process, int options) {
  siginfo_t end = {};
  int result = 0;
  do {
    result = ::waitid(P_PID, static_cast<id_t>(process), &end, WEXITED | WNOWAIT | options);
  } while (result < 0 && errno == EINTR);
  if (result == 0 && end.si_pid == process) ::kill(-process, SIGKILL);
}

/// Reads all pipes to their ends, in any order; `look` is called after each piece.
void read_all(int process, const std::array<Pipe, kStreams>& pipes, std::array<std::string, kStreams>& texts,
              const std::function<void()>& check) {
  constexpr int kSilenceMs = 100;
  std::array<pollfd, kStreams> waiting{};
  for (std::size_t i = 0; i < kStreams; ++i)
    waiting[i] = {.fd = pipes[i].read, .events = POLLIN, .revents = 0};
  std::size_t open = kStreams;
  while (open > 0) {
    const int found = ::poll(waiting.data(), waiting.size(), kSilenceMs);
    if (found < 0 && errno != EINTR) break;
    if (found == 0) end_group_of(process, WNOHANG);
    if (found <= 0) continue;
    for (std::size_t i = 0; i < kStreams; ++i) {
      if (waiting[i].fd < 0 || waiting[i].revents == 0) continue;
      std::array<char, 4096> chunk{};
      const ssize_t bytes = ::read(waiting[i].fd, chunk.data(), chunk.size());
      if (bytes > 0) texts[i].append(chunk.data(), static_cast<std::size_t>(bytes));
      if (bytes != 0) continue;
      waiting[i].fd = -1;
      --open;
    }
    check();
  }
}

ExitStatus to_status(int raw) {
  if (WIFSIGNALED(raw)) return {.code = 0, .signal = WTERMSIG(raw)};
  return {.code = WEXITSTATUS(raw), .signal = 0};
}

}  // namespace

bool ExitStatus::is_killed() const noexcept {
  return signal == SIGKILL || signal == SIGTERM || signal == SIGINT;
}

std::string ExitStatus::in_words() const {
  if (signal != 0) return fmt::format("was killed by signal {} ({})", signal, ::strsignal(signal));
  return fmt::format("ended with exit code {}", code);
}

ChildProcess::ChildProcess(const std::vector<std::string>& argv, const Path& log) {
  const std::vector<std::string> variables = child_environment();
  const std::vector<char*> environment = pointers(variables);
  const std::vector<char*> arguments = pointers(argv);
  const Pipe pipe;
  const int input = open_high("/dev/null", O_RDONLY);
  const int output = open_high(log.c_str(), O_WRONLY | O_CREAT | O_APPEND);
  const int parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) become(arguments.data(), environment.data(), input, output, output, pipe.write, parent);
  ::close(input);
  ::close(output);
  ::close(pipe.write);
  events_ = pipe.read;
  if (process_ < 0) {
    ::close(events_);
    fail("start " + argv.front());
  }
}

ChildProcess::~ChildProcess() {
  if (!status_) {
    ::kill(-process_, SIGKILL);
    (void)try_wait(0);
  }
  ::close(events_);
}

std::optional<std::string> ChildProcess::take_line() {
  std::optional<std::string> line = first_line(buffer_);
  if (!line && closed_) buffer_.clear();  // an incomplete line of a killed program: discarded
  return line;
}

std::optional<std::string> ChildProcess::next_line(int timeout_ms) {
  if (auto line = take_line()) return line;
  if (closed_) return std::nullopt;
  pollfd waiting = {.fd = events_, .events = POLLIN, .revents = 0};
  if (::poll(&waiting, 1, timeout_ms) <= 0) return std::nullopt;
  std::array<char, 4096> chunk{};
  const ssize_t bytes = ::read(events_, chunk.data(), chunk.size());
  if (bytes > 0) buffer_.append(chunk.data(), static_cast<std::size_t>(bytes));
  if (bytes == 0 || (bytes < 0 && errno != EINTR)) closed_ = true;
  return take_line();
}

bool ChildProcess::try_wait(int options) {
  if (status_) return true;
  int raw = 0;
  int ended = 0;
  do {
    ended = ::waitpid(process_, &raw, options);
  } while (ended < 0 && errno == EINTR);
  if (ended == process_) status_ = to_status(raw);
  return status_.has_value();
}

ExitStatus ChildProcess::wait() {
  (void)try_wait(0);
  return status_.value_or(ExitStatus{});
}

void ChildProcess::stop() {
  constexpr int kPatienceMs = 2000;
  constexpr int kStepMs = 20;
  ::kill(-process_, SIGTERM);
  for (int waited_ms = 0; waited_ms < kPatienceMs && !try_wait(WNOHANG); waited_ms += kStepMs) {
    std::this_thread::sleep_for(std::chrono::milliseconds(kStepMs));
  }
  ::kill(-process_, SIGKILL);
  (void)try_wait(0);
}

std::string Output::last_error_line() const {
  std::string last;
  std::istringstream lines(error);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

Output run_program(const std::vector<std::string>& argv, std::string_view input_text,
                   const std::function<void(const std::string&)>& take_event) {
  const std::vector<std::string> variables = child_environment();
  const std::vector<char*> environment = pointers(variables);
  const std::vector<char*> arguments = pointers(argv);
  const std::array<Pipe, kStreams> pipes;
  const int input = open_text(input_text);
  const int events = take_event ? pipes[2].write : -1;
  const int parent = ::getpid();
  const int process = ::fork();
  if (process == 0)
    become(arguments.data(), environment.data(), input, pipes[0].write, pipes[1].write, events, parent);
  ::close(input);
  for (const Pipe& pipe : pipes) ::close(pipe.write);
  if (process < 0) fail("start " + argv.front());
  std::array<std::string, kStreams> texts;
  read_all(process, pipes, texts, [&] {
    while (const auto line = first_line(texts[2])) take_event(*line);
  });
  for (const Pipe& pipe : pipes) ::close(pipe.read);
  end_group_of(process, 0);
  int raw = 0;
  while (::waitpid(process, &raw, 0) < 0 && errno == EINTR) {
  }
  return {.status = to_status(raw), .out = std::move(texts[0]), .error = std::move(texts[1])};
}

namespace {

bool can_run(const Path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

}  // namespace

Path find_program(const std::string& name) {
  if (name.find('/') != std::string::npos) return can_run(name) ? std::filesystem::absolute(name) : Path();
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const Path candidate = Path(folder) / name;
    if (can_run(candidate)) return std::filesystem::absolute(candidate);
  }
  return {};
}

}  // namespace thermal
