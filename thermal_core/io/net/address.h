#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace thermal {

/// A destination as a URL: scheme://host:port/path.
struct NetAddress {
  std::string scheme;  ///< in small letters
  std::string host;    ///< without the brackets of IPv6
  std::uint16_t port = 0;
  std::string path;  ///< with its slash, or empty

  /// Whether the host is this machine, unreachable from others: 127.0.0.0/8, ::1 or "localhost".
  [[nodiscard]] bool is_loopback() const;

  /// "udp://[::1]:5600".
  [[nodiscard]] std::string url() const;
};

/// ConfigError for an address that others can reach; `permit` is the option that allows it, such as "--allow-remote".
void check_is_loopback(const NetAddress& address, const std::string& where, const std::string& permit);

/// ConfigError with `where` (such as "--video") for another text, one with spaces or control characters, a scheme that is
/// not among `schemes`, and a port that is not 1 to 65535.
[[nodiscard]] NetAddress parse_address(std::string_view text, const std::vector<std::string>& schemes,
                                       const std::string& where);

}  // namespace thermal
