#include "base/error.h"
#include "base/parallel.h"
#include "io/video/h264_file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace preview_video_test {

using namespace thermal;

namespace {

std::string video(const TestFolder& folder, int width_px, int height_px) {
  const Path file = folder / "video.mp4";
  PreviewVideo writer(file, 7.5, width_px, height_px);
  for (int i = 0; i < 5; ++i) {
    Plane<std::uint8_t> frame(width_px, height_px, static_cast<std::uint8_t>(50 * i));
    frame.at(0, 0) = 255;
    writer.add(frame);
  }
  writer.close();
  return read_file(file);
}

}  // namespace

TEST_CASE("A video is an MP4 of H.264, and the same bytes each time, whatever the threads") {
  const TestFolder folder;
  const std::string once = video(folder, 64, 48);
  CHECK(once.substr(4, 4) == "ftyp");
  CHECK(once.find("avc1") != std::string::npos);
  CHECK(with_threads(1, [&] { return video(folder, 64, 48); }) == once);
}

TEST_CASE("A video may have any size, odd ones too") {
  const TestFolder folder;
  for (const auto& [width_px, height_px] :
       {std::pair(1, 1), std::pair(1, 37), std::pair(37, 1), std::pair(63, 47)}) {
    CAPTURE(width_px, height_px);
    CHECK(video(folder, width_px, height_px).size() > 500);
  }
}

TEST_CASE("A video that cannot be written is reported by name, with the reason") {
  const TestFolder folder;
  const Path file = folder / "none/video.mp4";
  CHECK(message_of<IoError>([&] { const PreviewVideo video(file, 9, 8, 8); }) ==
        "cannot write " + file.string() + ": No such file or directory");
}

TEST_CASE("A full disk is reported when the video is written, as a TryAgainError") {
  const auto write = [] {
    PreviewVideo writer("/dev/full", 9, 8, 8);
    writer.add(Plane<std::uint8_t>(8, 8));
    writer.close();
  };
  CHECK(message_of<TryAgainError>(write) == "cannot write /dev/full: No space left on device");
}

}  // namespace preview_video_test
