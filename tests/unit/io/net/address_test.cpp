#include "io/net/address.h"

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace address_test {

using namespace thermal;

TEST_CASE("A URL has scheme, host, port and path") {
  const NetAddress plain = parse_address("UDP://127.0.0.1:5600", {"udp", "rtsp"}, "--video");
  CHECK(plain.scheme == "udp");
  CHECK(plain.host == "127.0.0.1");
  CHECK(plain.port == 5600);
  CHECK(plain.path.empty());
  const NetAddress v6 = parse_address("rtsp://[::1]:8554/a/b", {"udp", "rtsp"}, "--video");
  CHECK(v6.host == "::1");
  CHECK(v6.port == 8554);
  CHECK(v6.path == "/a/b");
  CHECK(v6.url() == "rtsp://[::1]:8554/a/b");
}

TEST_CASE("What is no URL of these schemes is refused") {
  for (const char* text :
       {"", "udp", "udp://", "udp://host", "udp://:5600", "udp://host:", "udp://host:0", "udp://host:65536",
        "udp://host:56x", "http://host:80", "host:5600", "udp://ho st:5600", "udp://host:5600/a\nb"})
    CHECK(message_of<ConfigError>([&] {
            (void)parse_address(text, {"udp", "tcp"}, "--labels");
          }) == std::string("--labels = \"") + text + "\"; expected udp://HOST:PORT or tcp://HOST:PORT");
}

TEST_CASE("A host does not end at a zero byte before its end") {
  using namespace std::string_view_literals;
  CHECK_THROWS_AS(parse_address("udp://127.0.0.1\0.example:5600"sv, {"udp"}, "--video"), ConfigError);
}

TEST_CASE("Only addresses of this machine are loopback") {
  for (const char* host : {"127.0.0.1", "127.255.0.9", "::1", "localhost"})
    CHECK(NetAddress{.scheme = "udp", .host = host, .port = 1, .path = ""}.is_loopback());
  for (const char* host : {"0.0.0.0", "128.0.0.1", "::", "fe80::1", "localhost.example", "224.0.0.1"})
    CHECK_FALSE(NetAddress{.scheme = "udp", .host = host, .port = 1, .path = ""}.is_loopback());
}

}  // namespace address_test
