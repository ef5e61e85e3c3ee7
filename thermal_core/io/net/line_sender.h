#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "io/net/address.h"

namespace thermal {

/// Sends lines of text to whoever listens, and never waits for them. `udp`: a datagram a line. `tcp`: a server for 16
/// clients at most; a further one is closed at once. Clients are taken when a line is sent, 64 at most for each line, and
/// get the lines from then on. A client that reads more slowly than lines come misses whole lines once 1 MiB wait for it,
/// or a single longer line. What clients send is not read.
class LineSender {
 public:
  struct Counts {
    std::int64_t sent = 0;     ///< lines, to each client
    std::int64_t missed = 0;   ///< lines that a slow client did not get, and those too long for a datagram
    int clients = 0;           ///< now
    std::int64_t refused = 0;  ///< clients that were one too many
  };

  static constexpr int kMostClients = 16;

  /// IoError if the host is unknown, or the port of a server in use.
  explicit LineSender(const NetAddress& address);
  ~LineSender();
  LineSender(const LineSender&) = delete;
  LineSender& operator=(const LineSender&) = delete;

  /// Sends a line, to which a line end is added.
  void send(std::string_view line);

  /// Gives slow clients `seconds` at most to read what waits for them.
  void finish(double seconds);

  [[nodiscard]] Counts counts() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermal
