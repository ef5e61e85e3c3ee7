#include "io/preview_video.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <span>
#include <string>

#include <fmt/format.h>

#include "base/error.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/log.h>
#include <libavutil/opt.h>
}

namespace thermal {
namespace {

/// H.264 stores colour at half size, so sides are even; a picture of odd size shows its edge twice.
int even(int size_px) { return size_px + size_px % 2; }

std::string reason_of(int error) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  return av_make_error_string(text.data(), text.size(), error);
}

struct FreeFormat {
  void operator()(AVFormatContext* format) const {
    if (format->pb != nullptr) avio_closep(&format->pb);
    avformat_free_context(format);
  }
};
struct FreeEncoder {
  void operator()(AVCodecContext* encoder) const { avcodec_free_context(&encoder); }
};
struct FreePicture {
  void operator()(AVFrame* picture) const { av_frame_free(&picture); }
};
struct FreePacket {
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};

/// Black to white as video has them: 16 to 235 (ITU-R BT.601).
std::uint8_t video_level(std::uint8_t level) {
  const auto scaled = static_cast<std::uint16_t>(219 * level + 127);  // at most 55,972
  return static_cast<std::uint8_t>(16 + scaled / 255);
}

}  // namespace

struct PreviewVideo::Impl {
  Path file;
  std::unique_ptr<AVFormatContext, FreeFormat> format;
  std::unique_ptr<AVCodecContext, FreeEncoder> encoder;
  std::unique_ptr<AVFrame, FreePicture> picture{av_frame_alloc()};
  std::unique_ptr<AVPacket, FreePacket> packet{av_packet_alloc()};

  void check(int result) const {
    if (result >= 0) return;
    const bool full = result == AVERROR(ENOSPC) || result == AVERROR(EDQUOT);
    if (full) throw TryAgainError(fmt::format("cannot write {}: {}", file.string(), reason_of(result)));
    throw IoError(fmt::format("cannot write {}: {}", file.string(), reason_of(result)));
  }

  void open_file() {
    AVFormatContext* made = nullptr;
    check(avformat_alloc_output_context2(&made, nullptr, "mp4", nullptr));
    format.reset(made);
    format->flags |= AVFMT_FLAG_BITEXACT;  // no name of a library's version in the file
    check(avio_open(&format->pb, file.c_str(), AVIO_FLAG_WRITE));
  }

  void open_encoder(double frame_rate_hz, int width_px, int height_px) {
    const AVCodec* codec = avcodec_find_encoder_by_name("libx264");
    encoder.reset(codec == nullptr ? nullptr : avcodec_alloc_context3(codec));
    if (!encoder) throw IoError(fmt::format("cannot write {}: FFmpeg has no libx264", file.string()));
    encoder->width = even(width_px);
    encoder->height = even(height_px);
    encoder->pix_fmt = AV_PIX_FMT_YUV420P;  // what every browser plays
    encoder->framerate = av_d2q(frame_rate_hz, 100000);
    encoder->time_base = av_inv_q(encoder->framerate);
    encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    encoder->thread_count = 1;  // with more, bytes would depend on how many
    // "medium" takes twenty times as long for half the bytes, and the frames are there without loss.
    check(av_opt_set(encoder->priv_data, "preset", "ultrafast", 0));
    check(av_opt_set(encoder->priv_data, "crf", "26", 0));
    check(avcodec_open2(encoder.get(), codec, nullptr));
  }

  void begin() const {
    AVStream* stream = avformat_new_stream(format.get(), nullptr);
    check(stream == nullptr ? AVERROR(ENOMEM) : 0);
    stream->time_base = encoder->time_base;
    stream->avg_frame_rate = encoder->framerate;
    check(avcodec_parameters_from_context(stream->codecpar, encoder.get()));
    check(avformat_write_header(format.get(), nullptr));
    picture->format = encoder->pix_fmt;
    picture->width = encoder->width;
    picture->height = encoder->height;
    picture->pts = 0;
    check(av_frame_get_buffer(picture.get(), 0));
  }

  void draw(const Plane<std::uint8_t>& frame) const {
    for (int y = 0; y < picture->height; ++y) {
      const auto row = frame.row(std::min(y, frame.height_px() - 1));
      std::uint8_t* const out = picture->data[0] + static_cast<std::ptrdiff_t>(y) * picture->linesize[0];
      std::transform(row.begin(), row.end(), out, video_level);
      std::fill(out + row.size(), out + picture->width, video_level(row.back()));
    }
    constexpr std::uint8_t kNoColour = 128;
    for (const int plane : {1, 2})
      std::fill_n(picture->data[plane], picture->linesize[plane] * (picture->height / 2), kNoColour);
  }

  /// `what` null: there are no more.
  void encode(const AVFrame* what) const {
    check(avcodec_send_frame(encoder.get(), what));
    for (;;) {
      const int result = avcodec_receive_packet(encoder.get(), packet.get());
      if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
      check(result);
      packet->duration = 1;
      av_packet_rescale_ts(packet.get(), encoder->time_base, format->streams[0]->time_base);
      check(av_interleaved_write_frame(format.get(), packet.get()));
    }
  }
};

PreviewVideo::PreviewVideo(const Path& file, double frame_rate_hz, int width_px, int height_px)
    : impl_(std::make_unique<Impl>()) {
  av_log_set_level(AV_LOG_QUIET);  // what goes wrong is told by what is thrown
  impl_->file = file;
  impl_->open_file();
  impl_->open_encoder(frame_rate_hz, width_px, height_px);
  impl_->begin();
}

PreviewVideo::~PreviewVideo() = default;
PreviewVideo::PreviewVideo(PreviewVideo&&) noexcept = default;
PreviewVideo& PreviewVideo::operator=(PreviewVideo&&) noexcept = default;

void PreviewVideo::add(const Plane<std::uint8_t>& frame) {
  impl_->check(av_frame_make_writable(impl_->picture.get()));
  impl_->draw(frame);
  impl_->encode(impl_->picture.get());
  ++impl_->picture->pts;
}

void PreviewVideo::close() {
  impl_->encode(nullptr);
  impl_->check(av_write_trailer(impl_->format.get()));
  impl_->check(avio_closep(&impl_->format->pb));
}

}  // namespace thermal
