#include "dataset/stream/live_stream.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "dataset/run/clip_choice.h"
#include "dataset/run/world.h"

namespace thermal {
namespace {

using Clock = std::chrono::steady_clock;

Clock::duration duration_of(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

double seconds_of(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

/// False if the run is stopped before.
bool sleep_until(Clock::time_point time, const std::function<bool()>& stopped) {
  constexpr std::chrono::milliseconds kLook(50);
  while (!stopped()) {
    const auto left = time - Clock::now();
    if (left <= Clock::duration::zero()) return true;
    std::this_thread::sleep_for(std::min<Clock::duration>(left, kLook));
  }
  return false;
}

/// A stream for cameras of one size and rate, which begins with the first frame.
struct Outlet {
  StreamTarget target;
  FrameStream stream;
  std::optional<Clock::time_point> begin = {};

  explicit Outlet(const StreamTarget& to) : target(to), stream(to) {}

  [[nodiscard]] bool fits(const StreamTarget& other) const {
    return target.frame_rate_hz == other.frame_rate_hz && target.width_px == other.width_px &&
           target.height_px == other.height_px;
  }

  /// In frames since the stream's begin.
  [[nodiscard]] std::int64_t count_at(Clock::time_point due) const {
    return std::llround(seconds_of(due - *begin) * target.frame_rate_hz);
  }

  /// The first whole frame of the stream from now on.
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

/// What is known of a frame beside its pixels.
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
    for (int frame = 0; frame < count;) {
      const Clock::time_point due = begin + duration_of(frame / rate_hz);
      if (!sleep_until(due, stopped)) break;
      send(frame, first_s + frame / rate_hz, outlet_.count_at(due));
      const double late_s = seconds_of(Clock::now() - due);
      late_s_.push_back(late_s);
      const int left_out = std::min(frames_to_leave_out(late_s, rate_hz), count - 1 - frame);
      streamed_.late += left_out;
      frame += 1 + left_out;
      state(result());
    }
    return result();
  }

 private:
  void send(int frame, double time_s, std::int64_t count) {
    const ClipImager::Frame& made = world_.capture(world_.flight_pose_at(time_s), time_s);
    ++made_;
    outlet_.stream.send(made.pictures.ir8, count, line_of(world_, streamed_, count, frame, made));
  }

  /// Frames that still wait count as sent.
  [[nodiscard]] StreamedClip& result() {
    const FrameStream::Counts now = outlet_.stream.counts();
    streamed_.dropped = static_cast<int>(now.dropped - before_.dropped);
    streamed_.sent = made_ - streamed_.dropped;
    streamed_.lateness = lateness_of(late_s_);
    streamed_.fault = streamed_.dropped > 0 ? now.fault : "";
    return streamed_;
  }

  World& world_;
  Outlet& outlet_;
  FrameStream::Counts before_;
  StreamedClip streamed_;
  std::vector<double> late_s_;
  int made_ = 0;
};

}  // namespace

void stream_flights(const LiveStreamOptions& options, const std::function<bool()>& stopped,
                    const std::function<void(const StreamedClip&)>& state,
                    const std::function<void(const StreamedClip&)>& done) {
  const PlannedDataset planned = open_plan(options.plan, options.assets);
  const std::vector<std::string> clips = ids_of(choose_clips(planned.config, options.clips, {}));
  std::unique_ptr<Outlet> outlet;
  do {
    for (const std::string& clip : clips) {
      World world(options.plan, clip, options.assets,
                  {.frame_rate_hz = options.frame_rate_hz, .roam = false});
      const StreamTarget target = target_for(options, world);
      if (outlet && !outlet->fits(target)) outlet->stream.close();
      if (!outlet || !outlet->fits(target)) {
        outlet.reset();
        outlet = std::make_unique<Outlet>(target);
      }
      done(Flight(world, clip, *outlet).fly(stopped, state));
      if (stopped()) break;
    }
  } while (options.repeat && !stopped());
  if (outlet) outlet->stream.close();
}

}  // namespace thermal
