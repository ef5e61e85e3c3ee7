#include "dataset/live/live_stream.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>
#include <utility>

#include "base/error.h"
#include "dataset/live/world.h"
#include "dataset/run/options.h"

namespace thermal {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kStateEach(5);

Clock::duration duration_of(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

double seconds_of(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

/// False if the run is stopped meanwhile.
bool sleep_until(Clock::time_point time, const std::function<bool()>& stopped) {
  constexpr std::chrono::milliseconds kLook(50);
  while (!stopped()) {
    const auto left = time - Clock::now();
    if (left <= Clock::duration::zero()) return true;
    std::this_thread::sleep_for(std::min<Clock::duration>(left, kLook));
  }
  return false;
}

/// A stream for cameras of one size and rate, which starts with the first frame.
struct Outlet {
  StreamTarget target;
  FrameStream stream;
  std::optional<Clock::time_point> begin = {};

  Outlet(const StreamTarget& to, const std::function<bool()>& stopped) : target(to), stream(to, stopped) {}

  [[nodiscard]] bool fits(const StreamTarget& other) const {
    return target.frame_rate_hz == other.frame_rate_hz && target.width_px == other.width_px &&
           target.height_px == other.height_px;
  }

  /// In frames since the stream's start.
  [[nodiscard]] std::int64_t count_at(Clock::time_point due) const {
    return std::llround(seconds_of(due - *begin) * target.frame_rate_hz);
  }

  /// Time of the next whole frame of the stream.
  [[nodiscard]] Clock::time_point next_frame() {
    const Clock::time_point now = Clock::now();
    if (!begin) begin = now;
    const double frames = std::ceil(seconds_of(now - *begin) * target.frame_rate_hz);
    return *begin + duration_of(frames / target.frame_rate_hz);
  }
};

StreamTarget target_for(const LiveStreamOptions& options, const World& world) {
  const CameraIntrinsics& camera = world.clip().manifest().camera;
  return {.video = options.video,
          .lines = options.lines,
          .frame_rate_hz = world.frame_rate_hz(),
          .width_px = camera.width_px,
          .height_px = camera.height_px};
}

/// A frame's metadata as a line of JSON.
std::string line_of(const World& world, const StreamedClip& clip, std::int64_t count, int frame,
                    const ClipImager::Frame& made) {
  Json pose = Json::array();
  const ManifestFrame& of = world.frame();
  for (std::size_t row = 0; row < 4; ++row)
    pose.push_back(
        std::vector<double>(of.camera_to_world->begin() + static_cast<std::ptrdiff_t>(4 * row),
                            of.camera_to_world->begin() + static_cast<std::ptrdiff_t>(4 * row + 4)));
  return Json{{"stream_s", static_cast<double>(count) / clip.frame_rate_hz},
              {"clip", clip.clip},
              {"frame", frame},
              {"time_s", of.time_s},
              {"camera_to_world", std::move(pose)},
              {"shutter_closed", made.pictures.shutter_closed},
              {"left_out", clip.late + clip.dropped},
              {"labels", world.clip().labels()}}
      .dump();
}

/// Sends one clip from its first frame to its last.
class Flight {
 public:
  Flight(World& world, std::string clip, Outlet& outlet)
      : world_(world), outlet_(outlet), before_(outlet.stream.counts()) {
    streamed_.clip = std::move(clip);
    streamed_.frame_rate_hz = world.frame_rate_hz();
  }

  StreamedClip fly(const std::function<bool()>& stopped,
                   const std::function<void(const StreamedClip&)>& state) {
    const double rate_hz = world_.frame_rate_hz();
    const double first_s = world_.flight_s().front();
    constexpr double kRounded = 1e-6;  // of a frame
    const int count = static_cast<int>((world_.flight_s().back() - first_s) * rate_hz + kRounded) + 1;
    const Clock::time_point begin = outlet_.next_frame();
    Clock::time_point state_due = begin + kStateEach;
    for (int frame = 0; frame < count;) {
      const Clock::time_point due = begin + duration_of(frame / rate_hz);
      if (!sleep_until(due, stopped)) break;
      send(frame, first_s + frame / rate_hz, outlet_.count_at(due));
      const double late_s = seconds_of(Clock::now() - due);
      late_s_.push_back(late_s);
      const int left_out = std::min(frames_to_leave_out(late_s, rate_hz), count - 1 - frame);
      streamed_.late += left_out;
      frame += 1 + left_out;
      if (Clock::now() < state_due) continue;
      state_due += kStateEach;
      state(result());
    }
    settle(stopped);
    return result();
  }

 private:
  void send(int frame, double time_s, std::int64_t count) {
    const ClipImager::Frame& made = world_.capture(world_.flight_pose_at(time_s), time_s);
    count_frames();
    outlet_.stream.send(made.pictures.ir8, count, line_of(world_, streamed_, count, frame, made));
  }

  /// Waits until the last frames are sent or dropped.
  void settle(const std::function<bool()>& stopped) {
    constexpr std::chrono::milliseconds kLook(10);
    while (!stopped() && outlet_.stream.counts().waiting > 0) std::this_thread::sleep_for(kLook);
    if (stopped()) outlet_.stream.close();
  }

  void count_frames() {
    const FrameStream::Counts now = outlet_.stream.counts();
    streamed_.sent = static_cast<int>(now.sent - before_.sent);
    streamed_.dropped = static_cast<int>(now.dropped - before_.dropped);
    streamed_.lines_missed = now.lines_missed - before_.lines_missed;
    streamed_.clients_refused = now.clients_refused - before_.clients_refused;
    streamed_.fault = streamed_.dropped > 0 ? now.fault : "";
  }

  [[nodiscard]] const StreamedClip& result() {
    count_frames();
    streamed_.lateness = lateness_of(late_s_);
    return streamed_;
  }

  World& world_;
  Outlet& outlet_;
  FrameStream::Counts before_;
  StreamedClip streamed_;
  std::vector<double> late_s_;
};

/// Flies clips one after another, through one stream while their cameras are compatible.
class Flights {
 public:
  Flights(const LiveStreamOptions& options, const std::function<bool()>& stopped)
      : options_(options), stopped_(stopped) {}

  ~Flights() {
    if (outlet_) outlet_->stream.close();
  }
  Flights(const Flights&) = delete;
  Flights& operator=(const Flights&) = delete;

  StreamedClip fly(const std::string& clip, const std::function<void(const StreamedClip&)>& state) {
    enter(clip);
    connect();
    return Flight(*world_, clip, *outlet_).fly(stopped_, state);
  }

 private:
  void enter(const std::string& clip) {
    if (world_ && clip == clip_) {
      world_->restart(world_->clip().task().seed);
      return;
    }
    world_.reset();
    world_ = std::make_unique<World>(options_.plan, clip, options_.assets,
                                     WorldOptions{.frame_rate_hz = options_.frame_rate_hz, .roam = false});
    clip_ = clip;
  }

  void connect() {
    const StreamTarget target = target_for(options_, *world_);
    if (outlet_ && outlet_->fits(target)) return;
    if (outlet_) outlet_->stream.close();
    outlet_.reset();
    outlet_ = std::make_unique<Outlet>(target, stopped_);
  }

  const LiveStreamOptions& options_;
  const std::function<bool()>& stopped_;
  std::string clip_;
  std::unique_ptr<World> world_;
  std::unique_ptr<Outlet> outlet_;
};

}  // namespace

void stream_flights(const LiveStreamOptions& options, const std::function<bool()>& stopped,
                    const std::function<void(const StreamedClip&)>& state,
                    const std::function<void(const StreamedClip&)>& done) {
  const PlannedDataset planned = PlanStore(options.plan, options.assets).open();
  const std::vector<std::string> clips = ids_of(choose_clips(planned.config.spec, options.clips, {}));
  if (options.frame_rate_hz) check_frame_rate(*options.frame_rate_hz, "frame_rate_hz");
  Flights flights(options, stopped);
  try {
    do {
      for (const std::string& clip : clips) {
        if (stopped()) return;
        done(flights.fly(clip, state));
      }
    } while (options.repeat);
  } catch (const IoError&) {
    if (!stopped()) throw;  // the wait for the receiver was interrupted
  }
}

}  // namespace thermal
