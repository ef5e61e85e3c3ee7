#include "dataset/live/frame_stream.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/order_statistics.h"
#include "io/net/line_sender.h"
#include "io/video/h264_stream.h"

namespace thermal {

int frames_to_leave_out(double late_s, double frame_rate_hz) noexcept {
  return std::max(0, static_cast<int>(std::floor(late_s * frame_rate_hz)) - 1);
}

Lateness lateness_of(std::vector<double> late_s) {
  if (late_s.empty()) return {};
  std::ranges::sort(late_s);
  return {
      .median_s = nearest_rank(late_s, 0.5), .high_s = nearest_rank(late_s, 0.95), .most_s = late_s.back()};
}

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostWaiting = 4;
constexpr std::chrono::seconds kRetry(1);
constexpr std::chrono::seconds kLastWords(2);

constexpr double kLeastRateHz = 0.1;
constexpr double kMostRateHz = 240;
constexpr int kMostSidePx = 8192;

struct Item {
  Plane<std::uint8_t> frame;
  std::int64_t time = 0;
};

void check_side(int side_px, const char* where) {
  if (side_px >= 1 && side_px <= kMostSidePx) return;
  throw ConfigError(fault(where, fmt::format("{}", side_px), "px", fmt::format("1 to {}", kMostSidePx)));
}

const StreamTarget& checked(const StreamTarget& target) {
  check_frame_rate(target.frame_rate_hz, "frame_rate_hz");
  check_side(target.width_px, "width_px");
  check_side(target.height_px, "height_px");
  return target;
}

}  // namespace

NetAddress parse_video_address(const std::string& url, const std::string& where) {
  return parse_address(url, {"udp", "rtsp"}, where);
}

NetAddress parse_line_address(const std::string& url, const std::string& where) {
  return parse_address(url, {"tcp", "udp"}, where);
}

void check_frame_rate(double frame_rate_hz, const std::string& where) {
  if (frame_rate_hz >= kLeastRateHz && frame_rate_hz <= kMostRateHz) return;
  throw ConfigError(fault(where, fmt::format("{:g}", frame_rate_hz), "Hz",
                          fmt::format("{} to {}", kLeastRateHz, kMostRateHz)));
}

struct FrameStream::Impl {
  StreamTarget target;
  std::function<bool()> stopped;      ///< called while there is no receiver
  std::atomic<bool> cut = false;      ///< all waits end
  std::unique_ptr<H264Stream> video;  ///< the sender's; null while there is no receiver
  mutable std::mutex mutex;           ///< protects all members below
  std::condition_variable changed;
  std::unique_ptr<LineSender> lines;
  std::deque<Item> waiting;
  Counts counts;
  bool closing = false;
  bool done = false;
  std::thread sender;

  Impl(const StreamTarget& to, std::function<bool()> ask)
      : target(checked(to)), stopped(std::move(ask)), video(connect()) {
    stopped = {};
    if (target.lines) lines = std::make_unique<LineSender>(*target.lines);
    sender = std::thread([this] { run(); });
  }

  [[nodiscard]] std::unique_ptr<H264Stream> connect() {
    return std::make_unique<H264Stream>(target.video, target.frame_rate_hz, target.width_px, target.height_px,
                                        [this] { return cut.load() || (stopped && stopped()); });
  }

  /// The next item; none at the end.
  std::optional<Item> next() {
    std::unique_lock lock(mutex);
    changed.wait(lock, [this] { return closing || !waiting.empty(); });
    if (waiting.empty()) return std::nullopt;
    Item item = std::move(waiting.front());
    waiting.pop_front();
    return item;
  }

  void note_fault(const Error& error) {
    video.reset();
    const std::lock_guard lock(mutex);
    counts.fault = error.what();
  }

  void send_video(const Item& item, Clock::time_point& retry_at) {
    try {
      if (!video && Clock::now() >= retry_at) video = connect();
      if (video) video->add(item.frame, item.time);
    } catch (const IoError& error) {
      note_fault(error);
      retry_at = Clock::now() + kRetry;
    }
    const std::lock_guard lock(mutex);
    ++(video ? counts.sent : counts.dropped);
    --counts.waiting;
  }

  void run() {
    Clock::time_point retry_at{};
    while (const std::optional<Item> item = next()) send_video(*item, retry_at);
    try {
      if (video) video->close();
    } catch (const IoError& error) {
      note_fault(error);
    }
    const std::lock_guard lock(mutex);
    done = true;
    changed.notify_all();
  }

  void drop_waiting() {
    counts.dropped += static_cast<std::int64_t>(waiting.size());
    counts.waiting -= static_cast<std::int64_t>(waiting.size());
    waiting.clear();
  }

  /// `patience`: time limit for the last frames and lines together; then the stream is cut.
  void close(Clock::duration patience) {
    if (!sender.joinable()) return;
    const Clock::time_point end = Clock::now() + patience;
    std::unique_lock lock(mutex);
    closing = true;
    changed.notify_all();
    lock.unlock();
    if (lines) lines->finish(std::chrono::duration<double>(patience).count());
    lock.lock();
    if (!changed.wait_until(lock, end, [this] { return done; })) {
      drop_waiting();
      cut = true;
    }
    lock.unlock();
    sender.join();
  }
};

FrameStream::FrameStream(const StreamTarget& target, std::function<bool()> stopped)
    : impl_(std::make_unique<Impl>(target, std::move(stopped))) {}

FrameStream::~FrameStream() { impl_->close({}); }

bool FrameStream::send(const Plane<std::uint8_t>& frame, std::int64_t time, std::string_view line) {
  const StreamTarget& target = impl_->target;
  if (frame.width_px() != target.width_px || frame.height_px() != target.height_px)
    throw ConfigError(fault("frame", fmt::format("{} x {}", frame.width_px(), frame.height_px()), "px",
                            fmt::format("{} x {}", target.width_px, target.height_px)));
  const std::lock_guard lock(impl_->mutex);
  Counts& counts = impl_->counts;
  if (impl_->lines && !impl_->closing) {
    impl_->lines->send(line);
    counts.lines_missed = impl_->lines->counts().missed;
    counts.clients_refused = impl_->lines->counts().refused;
  }
  if (impl_->closing || impl_->waiting.size() >= kMostWaiting) {
    ++counts.dropped;
    return false;
  }
  impl_->waiting.push_back({.frame = frame, .time = time});
  ++counts.waiting;
  impl_->changed.notify_all();
  return true;
}

void FrameStream::close() { impl_->close(kLastWords); }

FrameStream::Counts FrameStream::counts() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->counts;
}

}  // namespace thermal
