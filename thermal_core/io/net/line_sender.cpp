#include "io/net/line_sender.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "base/error.h"

namespace thermal {
namespace {

constexpr std::size_t kMostWaiting = std::size_t{1} << 20U;  // [bytes] for one client
constexpr int kMostAccepted = 64;                            // for one line
constexpr int kUnreadBytes = 4096;                           // that the kernel keeps of what a client sends

class Socket {
 public:
  explicit Socket(int number = -1) noexcept : number_(number) {}
  ~Socket() {
    if (number_ >= 0) close(number_);
  }
  Socket(Socket&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Socket& operator=(Socket&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  [[nodiscard]] int number() const noexcept { return number_; }

 private:
  int number_;
};

struct FreeAddresses {
  void operator()(addrinfo* list) const { freeaddrinfo(list); }
};

std::unique_ptr<addrinfo, FreeAddresses> resolve(const NetAddress& address, int type) {
  const addrinfo wanted = {.ai_flags = AI_NUMERICSERV,
                           .ai_family = AF_UNSPEC,
                           .ai_socktype = type,
                           .ai_protocol = 0,
                           .ai_addrlen = 0,
                           .ai_addr = nullptr,
                           .ai_canonname = nullptr,
                           .ai_next = nullptr};
  addrinfo* found = nullptr;
  const int error = getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &wanted, &found);
  if (error != 0) throw IoError(fmt::format("cannot send to {}: {}", address.url(), gai_strerror(error)));
  return std::unique_ptr<addrinfo, FreeAddresses>(found);
}

IoError failure(const NetAddress& address, const char* what) {
  return IoError(fmt::format("cannot {} {}: {}", what, address.url(), std::strerror(errno)));
}

struct Client {
  Socket socket;
  std::string waiting = {};
  std::size_t begun = 0;  ///< bytes of `waiting` that are sent

  [[nodiscard]] bool is_done() const noexcept { return begun == waiting.size(); }

  /// Sends as much as possible without blocking. False if the client is gone.
  bool push() {
    while (!is_done()) {
      const ssize_t sent = ::send(socket.number(), waiting.data() + begun, waiting.size() - begun,
                                  MSG_DONTWAIT | MSG_NOSIGNAL);
      if (sent < 0) return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
      begun += static_cast<std::size_t>(sent);
    }
    waiting.clear();
    begun = 0;
    return true;
  }

  /// False if the queue is full.
  bool queue(std::string_view line) {
    waiting.erase(0, begun);
    begun = 0;
    if (!waiting.empty() && waiting.size() + line.size() >= kMostWaiting) return false;
    waiting.append(line).push_back('\n');
    return true;
  }
};

}  // namespace

struct LineSender::Impl {
  Socket socket;
  bool datagrams = false;
  std::vector<Client> clients;
  Counts counts;

  void open(const NetAddress& address) {
    datagrams = address.scheme == "udp";
    const int type = datagrams ? SOCK_DGRAM : SOCK_STREAM;
    const auto found = resolve(address, type);
    socket = Socket(::socket(found->ai_family, type | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    if (socket.number() < 0) throw failure(address, "open a socket for");
    if (datagrams) {
      if (connect(socket.number(), found->ai_addr, found->ai_addrlen) != 0) throw failure(address, "send to");
      return;
    }
    const int yes = 1;  // allows to bind the port right after another server has closed it
    setsockopt(socket.number(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    setsockopt(socket.number(), SOL_SOCKET, SO_RCVBUF, &kUnreadBytes,
               sizeof kUnreadBytes);  // clients inherit it
    if (bind(socket.number(), found->ai_addr, found->ai_addrlen) != 0 || listen(socket.number(), 8) != 0)
      throw failure(address, "listen at");
  }

  /// Clients that cannot be accepted now, for lack of descriptors, are accepted at the next line.
  void accept_clients() {
    for (int k = 0; k < kMostAccepted; ++k) {
      Socket client(accept4(socket.number(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
      if (client.number() < 0) return;
      if (clients.size() < kMostClients)
        clients.push_back({.socket = std::move(client)});
      else
        ++counts.refused;
    }
  }

  void send_datagram(std::string_view line) {
    const std::string text = std::string(line) + '\n';
    // A missing listener is no error; neither is a full buffer.
    const ssize_t sent = ::send(socket.number(), text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    ++(sent < 0 && errno != ECONNREFUSED ? counts.missed : counts.sent);
  }

  void send_to_clients(std::string_view line) {
    accept_clients();
    for (Client& client : clients) ++(client.queue(line) ? counts.sent : counts.missed);
    std::erase_if(clients, [](Client& client) { return !client.push(); });
    counts.clients = static_cast<int>(clients.size());
  }
};

LineSender::LineSender(const NetAddress& address) : impl_(std::make_unique<Impl>()) { impl_->open(address); }

LineSender::~LineSender() = default;

void LineSender::send(std::string_view line) {
  if (impl_->datagrams)
    impl_->send_datagram(line);
  else
    impl_->send_to_clients(line);
}

void LineSender::finish(double seconds) {
  using std::chrono::steady_clock;
  const auto end = steady_clock::now() +
                   std::chrono::duration_cast<steady_clock::duration>(std::chrono::duration<double>(seconds));
  for (Client& client : impl_->clients) {
    while (!client.is_done()) {
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(end - steady_clock::now()).count();
      pollfd wait = {.fd = client.socket.number(), .events = POLLOUT, .revents = 0};
      if (left <= 0 || poll(&wait, 1, static_cast<int>(left)) <= 0 || !client.push()) break;
    }
  }
}

LineSender::Counts LineSender::counts() const noexcept { return impl_->counts; }

}  // namespace thermal
