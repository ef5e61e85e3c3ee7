#pragma once

namespace veldt {

/// From now on Ctrl-C and SIGTERM request a stop instead of ending the program; a second one ends it.
void watch_for_stop();

/// The signal that requested a stop; 0 if none did.
[[nodiscard]] int stop_signal() noexcept;

}  // namespace veldt
