#include "io/video/video_codec.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "base/rng.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace video_codec_test {

using namespace thermal;

namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 128;
constexpr int kFrames = 27;
constexpr double kRate = 9;
constexpr double kHigh = 20000;  // of kbit/s: 13 bits for each pixel

using Frame = Plane<std::uint8_t>;
using Frames = std::vector<Frame>;

/// Waves that move to the right under grain, as thermal frames have: sigma of 4 levels.
Frame picture(std::uint32_t number, int width_px = kWidth, int height_px = kHeight) {
  Frame frame(width_px, height_px);
  Plane<float> grain(width_px, height_px);
  fill_normal({.seed = 1, .stream = 1, .clip = 1, .frame = number}, 0, grain.pixels());
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) {
      const double phase = 2 * std::numbers::pi * (x - 2.0 * number) / 40 + 0.05 * y;
      const double level = 128 + 60 * std::sin(phase) + 4 * static_cast<double>(grain.at(x, y));
      frame.at(x, y) = static_cast<std::uint8_t>(std::lround(level));
    }
  return frame;
}

Frame ramp() {
  Frame frame(256, 64);
  for (int y = 0; y < frame.height_px(); ++y)
    for (int x = 0; x < frame.width_px(); ++x) frame.at(x, y) = static_cast<std::uint8_t>(x);
  return frame;
}

double mean_square_error(const Frame& one, const Frame& other) {
  double sum = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const double difference = static_cast<double>(one.pixels()[i]) - static_cast<double>(other.pixels()[i]);
    sum += difference * difference;
  }
  return sum / static_cast<double>(one.size());
}

struct Clip {
  Frames frames;
  double psnr_db = 0;  ///< of all frames
  double kbit_s = 0;
};

Clip pass(const std::string& name, double bitrate_kbit_s) {
  VideoCodec codec({.name = name, .bitrate_kbit_s = bitrate_kbit_s}, kRate, kWidth, kHeight);
  Clip clip;
  double error = 0;
  double bits = 0;
  for (std::uint32_t k = 0; k < kFrames; ++k) {
    Frame frame = picture(k);
    bits += 8.0 * static_cast<double>(codec.pass(frame));
    error += mean_square_error(frame, picture(k)) / kFrames;
    clip.frames.push_back(std::move(frame));
  }
  clip.psnr_db = 10 * std::log10(255 * 255 / error);
  clip.kbit_s = 1e-3 * bits * kRate / kFrames;
  return clip;
}

}  // namespace

TEST_CASE("Frames survive a codec at a high bit rate, and lose more the lower it is") {
  const std::string name = GENERATE("h264", "mpeg4", "mjpeg");
  CAPTURE(name);
  const Clip high = pass(name, kHigh);
  const Clip middle = pass(name, 300);
  const Clip low = pass(name, 120);
  CAPTURE(high.psnr_db, middle.psnr_db, low.psnr_db, high.kbit_s, middle.kbit_s, low.kbit_s);
  CHECK(high.psnr_db > 44);  // an error of rms 1.6 levels: the finest that Motion JPEG has
  CHECK(middle.psnr_db < high.psnr_db - 3);
  CHECK(low.psnr_db < middle.psnr_db - 1);
  CHECK(low.psnr_db > 20);
  CHECK(middle.kbit_s < 1.3 * 300);
}

TEST_CASE("A rate that is stated for another frame rate is in proportion") {
  const auto passed = [](const VideoCodecSettings& settings) {
    VideoCodec codec(settings, kRate, kWidth, kHeight);
    Frame frame = picture(0);
    (void)codec.pass(frame);
    return frame;
  };
  const Frame stated = passed({.name = "h264", .bitrate_kbit_s = 300});
  CHECK(passed({.name = "h264", .bitrate_kbit_s = 900, .bitrate_at_hz = 3 * kRate}) == stated);
  CHECK(passed({.name = "h264", .bitrate_kbit_s = 900}) != stated);
}

TEST_CASE("The whole range of grey passes a codec: black stays black, white stays white") {
  const std::string name = GENERATE("h264", "mpeg4", "mjpeg");
  CAPTURE(name);
  VideoCodec codec({.name = name, .bitrate_kbit_s = kHigh}, kRate, 256, 64);
  Frame frame;
  for (int k = 0; k < 3; ++k) {
    frame = ramp();
    (void)codec.pass(frame);
  }
  double sum = 0;
  for (std::size_t i = 0; i < frame.size(); ++i)
    sum += static_cast<double>(frame.pixels()[i]) - static_cast<double>(ramp().pixels()[i]);
  CHECK(std::abs(sum / static_cast<double>(frame.size())) < 0.6);
  CHECK(mean_square_error(frame, ramp()) < 1);  // of levels from 16 to 235: 108
  CHECK(frame.at(0, 32) <= 2);
  CHECK(frame.at(255, 32) >= 253);
}

TEST_CASE("A codec gives the same bits each time, whatever the threads") {
  const std::string name = GENERATE("h264", "mpeg4", "mjpeg");
  CAPTURE(name);
  const auto made = [&] { return pass(name, 300).frames; };
  const Frames once = with_threads(1, made);
  CHECK(with_threads(4, made) == once);
  CHECK(made() == once);
}

TEST_CASE("A codec returns each frame at once, and the first like any other") {
  const std::string name = GENERATE("h264", "mpeg4", "mjpeg");
  CAPTURE(name);
  const Frames frames = pass(name, kHigh).frames;
  for (std::uint32_t k = 0; k < kFrames; ++k) {
    CAPTURE(k);
    CHECK(mean_square_error(frames[k], picture(k)) < 12);  // a neighbour's is 350
  }
}

TEST_CASE("Frames of any size pass a codec") {
  const std::string name = GENERATE("h264", "mpeg4", "mjpeg");
  const auto [width_px, height_px] =
      GENERATE(std::pair(1, 1), std::pair(1, 37), std::pair(37, 1), std::pair(63, 47), std::pair(640, 511));
  CAPTURE(name, width_px, height_px);
  VideoCodec codec({.name = name, .bitrate_kbit_s = kHigh}, kRate, width_px, height_px);
  Frame frame = picture(0, width_px, height_px);
  CHECK(codec.pass(frame) > 0);
  CHECK(frame.width_px() == width_px);
  CHECK(frame.height_px() == height_px);
  CHECK(mean_square_error(frame, picture(0, width_px, height_px)) < 40);
}

TEST_CASE("Any frame rate of a config passes a codec") {
  const std::string name = GENERATE("h264", "mpeg4", "mjpeg");
  const double rate_hz = GENERATE(0.1, 7.5, 29.97, 60.0, 240.0);
  CAPTURE(name, rate_hz);
  VideoCodec codec({.name = name, .bitrate_kbit_s = 1000}, rate_hz, 64, 48);
  for (std::uint32_t k = 0; k < 3; ++k) {
    Frame frame = picture(k, 64, 48);
    CHECK(codec.pass(frame) > 0);
  }
}

TEST_CASE("A codec that FFmpeg lacks, or that cannot take the size, is named with what there is") {
  const std::string message = message_of<ConfigError>([] { check_video_codec({.name = "vc9"}, 9, 64, 48); });
  CHECK(message.starts_with("output.codec.name = \"vc9\"; expected a codec that the installed FFmpeg "));
  CHECK(message.ends_with(" encodes and decodes: h264, mpeg4, mjpeg"));
  CHECK(message_of<ConfigError>(
            [] { check_video_codec({.name = "mpeg4", .bitrate_kbit_s = 100}, 9, 9000, 48); }) ==
        "output.codec = \"mpeg4\" with 100 kbit/s; expected what the codec takes for 9000 x 48 px: "
        "Invalid argument");
}

}  // namespace video_codec_test
