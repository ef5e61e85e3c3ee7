#pragma once

namespace veldt {

/// From now on Ctrl-C and SIGTERM ask for a stop instead of ending the program at once; a second one ends it.
void watch_for_stop();

/// The signal that asked for a stop; 0 if none did.
[[nodiscard]] int stop_signal() noexcept;

}  // namespace veldt
