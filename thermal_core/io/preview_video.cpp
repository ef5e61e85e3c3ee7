#include "io/preview_video.h"

#include <algorithm>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "base/error.h"

namespace thermal {
namespace {

/// H.264 stores colour at half size, so sides are even; a picture of odd size shows its edge twice.
int even(int size_px) { return size_px + size_px % 2; }

}  // namespace

struct PreviewVideo::Impl {
  cv::VideoWriter writer;
  cv::Mat picture;
};

PreviewVideo::PreviewVideo(const Path& file, double frame_rate_hz, int width_px, int height_px)
    : impl_(std::make_unique<Impl>()) {
  const cv::Size size(even(width_px), even(height_px));
  impl_->picture.create(size, CV_8UC3);
  const int codec = cv::VideoWriter::fourcc('a', 'v', 'c', '1');
  if (!impl_->writer.open(file.string(), cv::CAP_FFMPEG, codec, frame_rate_hz, size, true)) {
    if (is_disk_full(file.parent_path()))
      throw TryAgainError(fmt::format("cannot write {}: No space left on device", file.string()));
    throw IoError(fmt::format("cannot write {}: OpenCV opened no H.264 encoder for {} x {} px", file.string(),
                              size.width, size.height));
  }
}

PreviewVideo::~PreviewVideo() = default;
PreviewVideo::PreviewVideo(PreviewVideo&&) noexcept = default;
PreviewVideo& PreviewVideo::operator=(PreviewVideo&&) noexcept = default;

void PreviewVideo::add(const Plane<std::uint8_t>& frame) {
  for (int y = 0; y < impl_->picture.rows; ++y) {
    const auto row = frame.row(std::min(y, frame.height_px() - 1));
    for (int x = 0; x < impl_->picture.cols; ++x) {
      const std::uint8_t value = row[static_cast<std::size_t>(std::min(x, frame.width_px() - 1))];
      impl_->picture.at<cv::Vec3b>(y, x) = cv::Vec3b::all(value);
    }
  }
  impl_->writer.write(impl_->picture);
}

}  // namespace thermal
