#pragma once

#include <cstdint>
#include <string>

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "support/catch.h"

namespace thermal {

inline sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

/// A socket of the other side, on this machine.
class Peer {
 public:
  explicit Peer(int type) : number_(socket(AF_INET, type, 0)) {}
  ~Peer() { close(number_); }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  [[nodiscard]] bool connect_to(std::uint16_t port) const {
    const sockaddr_in to = loopback(port);
    return connect(number_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  }

  /// A port that is free, which this socket takes.
  [[nodiscard]] std::uint16_t take_port() const {
    sockaddr_in at = loopback(0);
    socklen_t size = sizeof at;
    REQUIRE(bind(number_, reinterpret_cast<const sockaddr*>(&at), size) == 0);
    REQUIRE(getsockname(number_, reinterpret_cast<sockaddr*>(&at), &size) == 0);
    return ntohs(at.sin_port);
  }

  void be_served() const { REQUIRE(listen(number_, 1) == 0); }

  /// What arrives until nothing does for 0.3 s.
  [[nodiscard]] std::string read() const {
    std::string text;
    std::string part(1 << 16, '\0');
    pollfd wait = {.fd = number_, .events = POLLIN, .revents = 0};
    while (poll(&wait, 1, 300) > 0) {
      const ssize_t size = recv(number_, part.data(), part.size(), 0);
      if (size <= 0) break;
      text.append(part, 0, static_cast<std::size_t>(size));
    }
    return text;
  }

 private:
  int number_;
};

}  // namespace thermal
