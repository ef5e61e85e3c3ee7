#include "dataset/live/frame_stream.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/peer.h"

namespace frame_stream_test {

using namespace thermal;

namespace {

StreamTarget no_receiver() {
  return {.video = parse_video_address("udp://127.0.0.1:9", "--video"),
          .lines = parse_line_address("udp://127.0.0.1:9", "--labels"),
          .frame_rate_hz = 30,
          .width_px = 65,  // odd sides are encoded one pixel longer
          .height_px = 47};
}

}  // namespace

TEST_CASE("What waits is sent when the stream is closed, and nothing afterwards") {
  FrameStream stream(no_receiver());
  CHECK(stream.send(Plane<std::uint8_t>(65, 47, 100), 0, "{}"));
  CHECK(stream.send(Plane<std::uint8_t>(65, 47, 120), 5, "{}"));
  stream.close();
  CHECK(stream.counts().sent == 2);
  CHECK_FALSE(stream.send(Plane<std::uint8_t>(65, 47, 120), 6, "{}"));
  CHECK(stream.counts().dropped == 1);
  stream.close();
}

TEST_CASE("All frames are sent or counted as dropped, however quickly they come") {
  FrameStream stream(no_receiver());
  int taken = 0;
  for (int k = 0; k < 500; ++k) taken += stream.send(Plane<std::uint8_t>(65, 47, 100), k, "{}") ? 1 : 0;
  stream.close();
  CHECK(stream.counts().sent == taken);
  CHECK(stream.counts().sent + stream.counts().dropped == 500);
  CHECK(stream.counts().waiting == 0);
}

TEST_CASE("Frames of another size, and a server that does not answer, are faults") {
  FrameStream stream(no_receiver());
  CHECK(message_of<ConfigError>([&] { stream.send(Plane<std::uint8_t>(64, 48), 0, ""); }) ==
        "frame = 64 x 48 px; expected 65 x 47");
  StreamTarget refused = no_receiver();
  refused.video = parse_video_address("rtsp://127.0.0.1:9/veldt", "--video");
  CHECK(message_of<IoError>([&] { FrameStream{refused}; }) ==
        "cannot send to rtsp://127.0.0.1:9/veldt: Connection refused");
}

TEST_CASE("A server that accepts and never answers is given up after 5 s, or when the run is stopped") {
  const Peer silent(SOCK_STREAM);
  StreamTarget target = no_receiver();
  target.video = parse_video_address(fmt::format("rtsp://127.0.0.1:{}/veldt", silent.take_port()), "--video");
  silent.be_served();
  const std::string where = "cannot send to " + target.video.url() + ": ";
  CHECK(message_of<IoError>([&] { FrameStream{target}; }) == where + "no answer within 5 s");
  int asked = 0;
  CHECK(message_of<IoError>([&] { FrameStream(target, [&asked] { return ++asked > 2; }); }) ==
        where + "stopped");
}

TEST_CASE("Lines that cannot be sent are counted") {
  FrameStream stream(no_receiver());
  CHECK(
      stream.send(Plane<std::uint8_t>(65, 47, 100), 0, std::string(70'000, 'x')));  // no datagram is as long
  CHECK(stream.counts().lines_missed == 1);
}

TEST_CASE("A stream's rate and size have limits") {
  const auto fault_of = [](double rate_hz, int width_px, int height_px) {
    StreamTarget target = no_receiver();
    target.frame_rate_hz = rate_hz;
    target.width_px = width_px;
    target.height_px = height_px;
    return message_of<ConfigError>([&] { FrameStream{target}; });
  };
  CHECK(fault_of(0, 64, 48) == "frame_rate_hz = 0 Hz; expected 0.1 to 240");
  CHECK(fault_of(1e9, 64, 48) == "frame_rate_hz = 1e+09 Hz; expected 0.1 to 240");
  CHECK(fault_of(std::nan(""), 64, 48) == "frame_rate_hz = nan Hz; expected 0.1 to 240");
  CHECK(fault_of(9, 0, 48) == "width_px = 0 px; expected 1 to 8192");
  CHECK(fault_of(9, 64, 8193) == "height_px = 8193 px; expected 1 to 8192");
}

}  // namespace frame_stream_test
