#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "io/net/address.h"

namespace thermal {

/// Sends lines of text without ever blocking. `udp`: a datagram a line. `tcp`: a server for 16 clients at most; a
/// further one is closed at once. Clients are accepted when a line is sent, 64 at most for each line, and receive lines
/// from then on. A slow client misses whole lines while 1 MiB, or a single longer line, waits for it. Input from
/// clients is ignored.
class LineSender {
 public:
  struct Counts {
    std::int64_t sent = 0;     ///< lines, to each client
    std::int64_t missed = 0;   ///< lines that a slow client missed, and those too long for a datagram
    int clients = 0;           ///< at present
    std::int64_t refused = 0;  ///< clients beyond the limit
  };

  static constexpr int kMostClients = 16;

  /// IoError if the host is unknown, or the port of a server in use.
  explicit LineSender(const NetAddress& address);
  ~LineSender();
  LineSender(const LineSender&) = delete;
  LineSender& operator=(const LineSender&) = delete;

  /// Sends a line, to which a line end is added.
  void send(std::string_view line);

  /// Gives slow clients at most `seconds` to receive their queues.
  void finish(double seconds);

  [[nodiscard]] Counts counts() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermal
