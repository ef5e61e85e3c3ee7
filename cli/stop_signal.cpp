#include "cli/stop_signal.h"

#include <atomic>
#include <csignal>

namespace veldt {
namespace {

/// A signal handler can only reach a global; this is the program's only one.
std::atomic<int> received{0};  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

void remember(int signal) {
  received = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void watch_for_stop() {
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

int stop_signal() noexcept { return received; }

}  // namespace veldt
