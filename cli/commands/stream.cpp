#include <cstdio>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/planning.h"
#include "dataset/live/live_stream.h"
#include "dataset/plan/plan_store.h"
#include "io/assets.h"
#include "io/system/temporary.h"

namespace veldt {
namespace {

struct StreamArguments {
  std::string config;
  std::string video;
  std::string labels;
  std::vector<std::string> clips;
  std::vector<std::string> settings;
  std::optional<double> rate_hz;
  bool repeat = false;
  bool allow_remote = false;
};

void check_is_local(const thermal::NetAddress& address, const std::string& option, bool allow_remote) {
  if (!allow_remote) thermal::check_is_loopback(address, option, "--allow-remote");
}

thermal::LiveStreamOptions request_of(const StreamArguments& options) {
  thermal::LiveStreamOptions request = {.plan = options.config,
                                        .assets = thermal::Assets::find(),
                                        .clips = options.clips,
                                        .video = thermal::parse_video_address(options.video, "--video"),
                                        .frame_rate_hz = options.rate_hz,
                                        .repeat = options.repeat};
  check_is_local(request.video, "--video", options.allow_remote);
  if (!options.labels.empty()) {
    request.lines = thermal::parse_line_address(options.labels, "--labels");
    check_is_local(*request.lines, "--labels", options.allow_remote);
  }
  if (options.rate_hz) thermal::check_frame_rate(*options.rate_hz, "--rate");
  return request;
}

/// Plans a config into the folder, for live flights.
void plan_into_folder(const StreamArguments& options, const thermal::Path& folder,
                      const thermal::Assets& assets, const CommonOptions& common) {
  std::vector<std::string> settings = options.settings;
  settings.insert(settings.end(), {"render.engine=embree", "render.posed_actors=all"});
  const thermal::ResolvedConfig config = load_config(options.config, settings, assets);
  plan_with_progress(common, assets, [&](const thermal::PlanOptions& planning) {
    thermal::PlanStore(folder, assets).plan_with_config(config, options.config, planning);
  });
}

std::string words_of(const thermal::StreamedClip& clip) {
  const thermal::Lateness& late = clip.lateness;
  std::string words = fmt::format(
      "{}: {} of {} frames sent at {:g} Hz, {} left out, {} dropped; {:.0f} ms after they were due "
      "({:.0f} ms for 95 %, {:.0f} ms at most)",
      clip.clip, clip.sent, clip.frames(), clip.frame_rate_hz, clip.late, clip.dropped, 1e3 * late.median_s,
      1e3 * late.high_s, 1e3 * late.most_s);
  if (clip.lines_missed > 0) words += fmt::format("; {} lines missed", clip.lines_missed);
  if (clip.clients_refused > 0) words += fmt::format("; {} clients refused", clip.clients_refused);
  if (!clip.fault.empty()) words += "; " + clip.fault;
  return words;
}

int run_stream(const StreamArguments& options, const CommonOptions& common) {
  thermal::LiveStreamOptions request = request_of(options);
  watch_for_stop();
  std::optional<thermal::TemporaryFolder> folder;
  if (!std::filesystem::is_directory(options.config)) {
    folder.emplace();
    request.plan = folder->path() / "plan";
    plan_into_folder(options, request.plan, request.assets, common);
  } else if (!options.settings.empty()) {
    throw thermal::ConfigError(thermal::fault("--set", options.settings.front(), "", "a config, not a plan"));
  }
  bool any_lost = false;
  thermal::stream_flights(
      request, [] { return stop_signal() != 0; },
      [&common](const thermal::StreamedClip& clip) {
        if (!common.quiet) print_error("{}\n", words_of(clip));
      },
      [&](const thermal::StreamedClip& clip) {
        any_lost = any_lost || clip.late + clip.dropped + clip.lines_missed + clip.clients_refused > 0;
        if (common.quiet) return;
        print("{}\n", words_of(clip));
        std::fflush(stdout);  // readers of a pipe see each clip at once
      });
  if (stop_signal() != 0) return 128 + stop_signal();
  return any_lost ? kSomeRejected : kDone;
}

}  // namespace

void add_stream(Parser& parser) {
  Command command = parser.add_command(
      "stream", "Send what the cameras of a config see, live: video, and a line of JSON a frame");
  command.footer(
      "Frames that cannot be made in time are left out, and counted, as are frames and lines that a\n"
      "receiver misses, and clients beyond 16, which are closed at once; exit code 3 says that there were\n"
      "some.\n"
      "Receive the video with ffplay udp://127.0.0.1:5600, the lines with nc 127.0.0.1 5601. To push to\n"
      "RTSP, a server must run, or ffplay -rtsp_flags listen rtsp://127.0.0.1:8554/veldt.\n"
      "Example: veldt stream configs/demo.json --video udp://127.0.0.1:5600 --labels tcp://127.0.0.1:5601 "
      "--set render.supersample=1");
  auto options = std::make_shared<StreamArguments>();
  command.add_option("config", options->config, "Config of a dataset, JSON, or a plan with all actors' bones")
      .required()
      .type_name("CONFIG|PLAN");
  command
      .add_option("--video", options->video,
                  "Where video goes: udp://HOST:PORT (MPEG-TS) or rtsp://HOST:PORT/PATH")
      .required()
      .type_name("URL");
  command
      .add_option("--labels", options->labels,
                  "Where lines go: tcp://HOST:PORT, a server for 16 clients, or udp://HOST:PORT")
      .type_name("URL");
  command.add_option("--clips", options->clips, "Clips to send; all of them if not given")
      .comma_separated()
      .type_name("ID,…");
  command.add_option("--rate", options->rate_hz, "Frames a second, 0.1 to 240; each clip's own if not given")
      .type_name("HZ");
  command.add_flag("--repeat", options->repeat, "Begin again after the last clip, until stopped");
  command.add_flag("--allow-remote", options->allow_remote, "Accept addresses of other machines");
  add_settings(command, options->settings);
  command.runs([options](const CommonOptions& common) { return run_stream(*options, common); });
}

}  // namespace veldt
