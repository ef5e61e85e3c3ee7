#include "io/video/h264_file.h"

#include <cerrno>
#include <cstddef>

#include <fmt/format.h>

#include "base/error.h"
#include "io/video/ffmpeg.h"

namespace thermal {

struct H264File::Impl {
  ffmpeg::H264Writer writer;
  std::int64_t frames = 0;
};

namespace {

ffmpeg::H264Writer::Fault faults_of(const Path& file) {
  return [file](int error) {
    if (error == AVERROR_ENCODER_NOT_FOUND)
      throw IoError(fmt::format("cannot write {}: FFmpeg has no libx264", file.string()));
    const std::string text = fmt::format("cannot write {}: {}", file.string(), ffmpeg::reason_of(error));
    if (error == AVERROR(ENOSPC) || error == AVERROR(EDQUOT)) throw TryAgainError(text);
    throw IoError(text);
  };
}

}  // namespace

H264File::H264File(const Path& file, const H264Settings& settings)
    : impl_(new Impl{{{.format = "mp4", .url = file.string()}, settings, faults_of(file), nullptr}}) {}

H264File::~H264File() = default;
H264File::H264File(H264File&&) noexcept = default;
H264File& H264File::operator=(H264File&&) noexcept = default;

void H264File::add(const std::function<void(const Planes&)>& draw) {
  impl_->writer.add(draw, impl_->frames++);
}

void H264File::close() { impl_->writer.close(); }

void silence_ffmpeg() noexcept { av_log_set_level(AV_LOG_QUIET); }

// "medium" takes twenty times as long as "ultrafast" for half the bytes, and lossless frames exist anyway.
PreviewVideo::PreviewVideo(const Path& file, double frame_rate_hz, int width_px, int height_px)
    : file_(file, {.frame_rate_hz = frame_rate_hz,
                   .width_px = width_px,
                   .height_px = height_px,
                   .preset = "ultrafast",
                   .quality = 26,
                   .threads = 1}) {}

void PreviewVideo::add(const Plane<std::uint8_t>& frame) {
  file_.add([&frame](const VideoPlanes& planes) { draw_grey(frame, planes); });
}

void PreviewVideo::close() { file_.close(); }

}  // namespace thermal
