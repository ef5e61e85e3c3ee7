#include "io/net/address.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

/// Splits the part after "://" at its last colon before the path.
std::optional<NetAddress> split(std::string_view text) {
  const auto is_blank = [](unsigned char letter) { return letter <= ' ' || letter == 0x7f; };
  if (std::ranges::any_of(text, is_blank)) return {};
  const std::size_t scheme = text.find("://");
  if (scheme == std::string_view::npos) return {};
  const std::string_view rest = text.substr(scheme + 3);
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  std::string_view host = rest.substr(0, slash);
  const std::size_t colon = host.rfind(':');
  if (colon == std::string_view::npos) return {};
  const std::string_view digits = host.substr(colon + 1);
  host = host.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  NetAddress address = {.scheme = lower_case(std::string(text.substr(0, scheme))),
                        .host = std::string(host),
                        .port = 0,
                        .path = std::string(rest.substr(slash))};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), address.port);
  const bool whole = error == std::errc{} && end == digits.data() + digits.size();
  if (!whole || address.port == 0 || host.empty()) return {};
  return address;
}

}  // namespace

bool NetAddress::is_loopback() const {
  in_addr v4{};
  in6_addr v6{};
  if (inet_pton(AF_INET, host.c_str(), &v4) == 1) return (ntohl(v4.s_addr) >> 24U) == 127;
  if (inet_pton(AF_INET6, host.c_str(), &v6) == 1) return IN6_IS_ADDR_LOOPBACK(&v6);
  return host == "localhost";
}

std::string NetAddress::url() const {
  const bool v6 = host.find(':') != std::string::npos;
  return fmt::format("{}://{}{}{}:{}{}", scheme, v6 ? "[" : "", host, v6 ? "]" : "", port, path);
}

void check_is_loopback(const NetAddress& address, const std::string& where, const std::string& permit) {
  if (address.is_loopback()) return;
  throw ConfigError(fault(where, address.url(), "", fmt::format("127.0.0.1, or {}", permit)));
}

NetAddress parse_address(std::string_view text, const std::vector<std::string>& schemes,
                         const std::string& where) {
  const std::optional<NetAddress> address = split(text);
  if (address && std::ranges::count(schemes, address->scheme) > 0) return *address;
  throw ConfigError(fault(where, fmt::format("\"{}\"", text), "",
                          fmt::format("{}://HOST:PORT", fmt::join(schemes, "://HOST:PORT or "))));
}

}  // namespace thermal
