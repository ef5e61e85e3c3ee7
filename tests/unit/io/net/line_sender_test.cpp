#include "io/net/line_sender.h"

#include <chrono>
#include <deque>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/resource.h>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/peer.h"

namespace line_sender_test {

using namespace thermal;

namespace {

NetAddress at(const char* scheme, std::uint16_t port) {
  return {.scheme = scheme, .host = "127.0.0.1", .port = port, .path = ""};
}

std::uint16_t free_port() { return Peer(SOCK_STREAM).take_port(); }

/// While it lives, the process can open nothing more.
class NoDescriptors {
 public:
  NoDescriptors() {
    REQUIRE(getrlimit(RLIMIT_NOFILE, &before_) == 0);
    const int next = open("/dev/null", O_RDONLY | O_CLOEXEC);
    close(next);
    const rlimit none = {.rlim_cur = static_cast<rlim_t>(next), .rlim_max = before_.rlim_max};
    REQUIRE(setrlimit(RLIMIT_NOFILE, &none) == 0);
  }
  ~NoDescriptors() { setrlimit(RLIMIT_NOFILE, &before_); }
  NoDescriptors(const NoDescriptors&) = delete;
  NoDescriptors& operator=(const NoDescriptors&) = delete;

 private:
  rlimit before_{};
};

}  // namespace

TEST_CASE("Clients get the lines from their connection on, and one that goes is no fault") {
  const std::uint16_t port = free_port();
  LineSender sender(at("tcp", port));
  sender.send("not received");
  const Peer stays(SOCK_STREAM);
  REQUIRE(stays.connect_to(port));
  {
    const Peer goes(SOCK_STREAM);
    REQUIRE(goes.connect_to(port));
    sender.send("one");
    CHECK(sender.counts().clients == 2);
    CHECK(goes.read(4) == "one\n");
  }
  for (int k = 0; k < 3; ++k) sender.send("two");
  CHECK(stays.read(16) == "one\ntwo\ntwo\ntwo\n");
  CHECK(sender.counts().clients == 1);
}

TEST_CASE("A client that does not read misses whole lines, and holds up no other") {
  const std::uint16_t port = free_port();
  LineSender sender(at("tcp", port));
  const Peer slow(SOCK_STREAM);
  const Peer quick(SOCK_STREAM);
  REQUIRE(slow.connect_to(port));
  REQUIRE(quick.connect_to(port));
  const std::string line(100'000, 'x');
  std::string read;
  for (int k = 0; k < 100; ++k) {
    sender.send(line);
    read += quick.read(line.size() + 1);
  }
  CHECK(read.size() == 100 * (line.size() + 1));
  CHECK(sender.counts().missed > 0);
  const auto lines = static_cast<std::size_t>(100 - sender.counts().missed);
  std::thread finish([&sender] { sender.finish(kPatienceMs / 1e3); });
  const std::string late = slow.read(lines * (line.size() + 1));
  finish.join();
  CHECK(late.size() == lines * (line.size() + 1));
  CHECK(slow.has_read_all());
}

TEST_CASE("A client too many is closed at once, and counted, until another one goes") {
  const std::uint16_t port = free_port();
  LineSender sender(at("tcp", port));
  std::deque<Peer> peers;
  const auto connect_one = [&] {
    REQUIRE(peers.emplace_back(SOCK_STREAM).connect_to(port));
    sender.send("line");
  };
  for (int k = 0; k < LineSender::kMostClients; ++k) connect_one();
  CHECK(sender.counts().clients == LineSender::kMostClients);
  CHECK(sender.counts().refused == 0);
  for (int k = 0; k < 100; ++k) {
    connect_one();
    CHECK(peers.back().read(1).empty());  // the end
    peers.pop_back();
  }
  CHECK(sender.counts().clients == LineSender::kMostClients);
  CHECK(sender.counts().refused == 100);
  peers.pop_front();
  for (int k = 0; k < 2; ++k) sender.send("line");  // the first shows that the client has gone
  connect_one();
  CHECK(peers.back().read(5) == "line\n");
  CHECK(sender.counts().clients == LineSender::kMostClients);
  CHECK(sender.counts().refused == 100);
}

TEST_CASE("Without descriptors, lines go on, and a client waits to be accepted") {
  const std::uint16_t port = free_port();
  LineSender sender(at("tcp", port));
  const Peer first(SOCK_STREAM);
  REQUIRE(first.connect_to(port));
  sender.send("one");
  const Peer second(SOCK_STREAM);
  REQUIRE(second.connect_to(port));
  {
    const NoDescriptors none;
    sender.send("two");
  }
  CHECK(first.read(8) == "one\ntwo\n");
  CHECK(sender.counts().clients == 1);
  sender.send("three");
  CHECK(second.read(6) == "three\n");
  CHECK(sender.counts().clients == 2);
}

TEST_CASE("What clients send is not read, and the kernel keeps little of it") {
  const std::uint16_t port = free_port();
  LineSender sender(at("tcp", port));
  const Peer talks(SOCK_STREAM);
  REQUIRE(talks.connect_to(port));
  sender.send("one");
  CHECK(talks.send_until_full() < 65'536);
  sender.send("two");
  CHECK(talks.read(8) == "one\ntwo\n");
}

TEST_CASE("Each line is a datagram, whether somebody listens or not") {
  std::uint16_t port = 0;
  {
    const Peer listener(SOCK_DGRAM);
    port = listener.take_port();
    LineSender sender(at("udp", port));
    sender.send("one");
    sender.send(std::string(70'000, 'x'));
    CHECK(listener.read(4) == "one\n");
    CHECK(listener.has_read_all());
    CHECK(sender.counts().sent == 1);
    CHECK(sender.counts().missed == 1);
  }
  LineSender sender(at("udp", port));
  for (int k = 0; k < 3; ++k) sender.send("not received");
  CHECK(sender.counts().missed == 0);
}

TEST_CASE("A port in use and an unknown host are faults") {
  const Peer other(SOCK_STREAM);
  const std::uint16_t port = other.take_port();
  other.be_served();
  CHECK(message_of<IoError>([&] { LineSender(at("tcp", port)); }) ==
        "cannot listen at tcp://127.0.0.1:" + std::to_string(port) + ": Address already in use");
  CHECK_THAT(message_of<IoError>(
                 [] { LineSender({.scheme = "udp", .host = "no.such.invalid", .port = 9, .path = ""}); }),
             Catch::Matchers::StartsWith("cannot send to udp://no.such.invalid:9: "));
}

}  // namespace line_sender_test
