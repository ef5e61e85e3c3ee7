#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "support/catch.h"
#include "support/patience.h"

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
  explicit Peer(int type) : number_(socket(AF_INET, type, 0)) {
    const timeval patience = {.tv_sec = kPatienceMs / 1000, .tv_usec = 0};
    setsockopt(number_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  }
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

  /// Bytes that the kernel took for the other side, until it took no more: hardly any are kept on this side.
  [[nodiscard]] std::size_t send_until_full() const {
    const int least = 4096;
    setsockopt(number_, SOL_SOCKET, SO_SNDBUF, &least, sizeof least);
    const std::string part(1000, 'x');
    std::size_t bytes = 0;
    for (;;) {
      const ssize_t sent = send(number_, part.data(), part.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
      if (sent <= 0) return bytes;
      bytes += static_cast<std::size_t>(sent);
    }
  }

  /// Waits for at least so many bytes, or for the end.
  [[nodiscard]] std::string read(std::size_t bytes) const {
    std::string text;
    std::string part(1 << 16, '\0');
    while (text.size() < bytes) {
      const ssize_t size = recv(number_, part.data(), part.size(), 0);
      if (size <= 0) break;
      text.append(part, 0, static_cast<std::size_t>(size));
    }
    return text;
  }

  /// Whether nothing has arrived that was not read.
  [[nodiscard]] bool has_read_all() const {
    pollfd look = {.fd = number_, .events = POLLIN, .revents = 0};
    return poll(&look, 1, 0) == 0;
  }

 private:
  int number_;
};

}  // namespace thermal
