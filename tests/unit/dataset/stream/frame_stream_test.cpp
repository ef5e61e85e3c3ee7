#include "dataset/stream/frame_stream.h"

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace frame_stream_test {

using namespace thermal;

namespace {

StreamTarget nobody() {
  return {.video = parse_video_address("udp://127.0.0.1:9", "--video"),
          .lines = parse_line_address("udp://127.0.0.1:9", "--labels"),
          .frame_rate_hz = 30,
          .width_px = 65,  // odd sides are encoded one pixel longer
          .height_px = 47};
}

}  // namespace

TEST_CASE("What waits is sent when the stream is closed, and nothing afterwards") {
  FrameStream stream(nobody());
  CHECK(stream.send(Plane<std::uint8_t>(65, 47, 100), 0, "{}"));
  CHECK(stream.send(Plane<std::uint8_t>(65, 47, 120), 5, "{}"));
  stream.close();
  CHECK(stream.counts().sent == 2);
  CHECK_FALSE(stream.send(Plane<std::uint8_t>(65, 47, 120), 6, "{}"));
  CHECK(stream.counts().dropped == 1);
  stream.close();
}

TEST_CASE("All frames are sent or counted as dropped, however quickly they come") {
  FrameStream stream(nobody());
  int taken = 0;
  for (int k = 0; k < 500; ++k) taken += stream.send(Plane<std::uint8_t>(65, 47, 100), k, "{}") ? 1 : 0;
  stream.close();
  CHECK(stream.counts().sent == taken);
  CHECK(stream.counts().sent + stream.counts().dropped == 500);
}

TEST_CASE("Frames of another size, and a server that does not answer, are faults") {
  FrameStream stream(nobody());
  CHECK(message_of<ConfigError>([&] { stream.send(Plane<std::uint8_t>(64, 48), 0, ""); }) ==
        "frame = 64 x 48 px; expected 65 x 47");
  StreamTarget refused = nobody();
  refused.video = parse_video_address("rtsp://127.0.0.1:9/veldt", "--video");
  CHECK(message_of<IoError>([&] { FrameStream{refused}; }) ==
        "cannot send to rtsp://127.0.0.1:9/veldt: Connection refused");
}

}  // namespace frame_stream_test
