#include "io/video/h264_file.h"

#include <cerrno>
#include <cstddef>

#include <fmt/format.h>

#include "base/error.h"

extern "C" {
#include <libavutil/opt.h>
}

#include "io/video/ffmpeg.h"

namespace thermal {

struct H264File::Impl {
  Path file;
  H264Settings settings;
  ffmpeg::Format format;
  ffmpeg::Codec encoder;
  ffmpeg::Picture picture{av_frame_alloc()};
  ffmpeg::Packet packet{av_packet_alloc()};

  void check(int result) const {
    if (result >= 0) return;
    const bool full = result == AVERROR(ENOSPC) || result == AVERROR(EDQUOT);
    if (full)
      throw TryAgainError(fmt::format("cannot write {}: {}", file.string(), ffmpeg::reason_of(result)));
    throw IoError(fmt::format("cannot write {}: {}", file.string(), ffmpeg::reason_of(result)));
  }

  void open_file() {
    AVFormatContext* made = nullptr;
    check(avformat_alloc_output_context2(&made, nullptr, "mp4", file.c_str()));
    format.reset(made);
    format->flags |= AVFMT_FLAG_BITEXACT;  // no name of a library's version in the file
    check(avio_open(&format->pb, file.c_str(), AVIO_FLAG_WRITE));
  }

  void open_encoder() {
    const AVCodec* codec = avcodec_find_encoder_by_name("libx264");
    encoder.reset(codec == nullptr ? nullptr : avcodec_alloc_context3(codec));
    if (!encoder) throw IoError(fmt::format("cannot write {}: FFmpeg has no libx264", file.string()));
    encoder->log_level_offset = ffmpeg::kSilent;
    encoder->width = ffmpeg::even(settings.width_px);
    encoder->height = ffmpeg::even(settings.height_px);
    encoder->pix_fmt = AV_PIX_FMT_YUV420P;  // what every browser plays
    encoder->framerate = av_d2q(settings.frame_rate_hz, 100000);
    encoder->time_base = av_inv_q(encoder->framerate);
    encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    encoder->thread_count = settings.threads;
    check(av_opt_set(encoder->priv_data, "preset", settings.preset.c_str(), 0));
    check(av_opt_set_int(encoder->priv_data, "crf", settings.quality, 0));
    check(avcodec_open2(encoder.get(), codec, nullptr));
  }

  void begin() const {
    AVStream* stream = avformat_new_stream(format.get(), nullptr);
    check(stream == nullptr ? AVERROR(ENOMEM) : 0);
    stream->time_base = encoder->time_base;
    stream->avg_frame_rate = encoder->framerate;
    check(avcodec_parameters_from_context(stream->codecpar, encoder.get()));
    if (settings.streamable) check(av_opt_set(format->priv_data, "movflags", "+faststart", 0));
    check(avformat_write_header(format.get(), nullptr));
    picture->format = encoder->pix_fmt;
    picture->width = encoder->width;
    picture->height = encoder->height;
    picture->pts = 0;
    check(av_frame_get_buffer(picture.get(), 0));
  }

  [[nodiscard]] Planes planes() const {
    return {.data = {picture->data[0], picture->data[1], picture->data[2]},
            .stride_px = {picture->linesize[0], picture->linesize[1], picture->linesize[2]},
            .width_px = picture->width,
            .height_px = picture->height};
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

H264File::H264File(const Path& file, const H264Settings& settings) : impl_(std::make_unique<Impl>()) {
  impl_->file = file;
  impl_->settings = settings;
  impl_->open_file();
  impl_->open_encoder();
  impl_->begin();
}

H264File::~H264File() = default;
H264File::H264File(H264File&&) noexcept = default;
H264File& H264File::operator=(H264File&&) noexcept = default;

void H264File::add(const std::function<void(const Planes&)>& draw) {
  impl_->check(av_frame_make_writable(impl_->picture.get()));
  draw(impl_->planes());
  impl_->encode(impl_->picture.get());
  ++impl_->picture->pts;
}

void H264File::close() {
  impl_->encode(nullptr);
  impl_->check(av_write_trailer(impl_->format.get()));
  impl_->check(avio_closep(&impl_->format->pb));
}

void silence_ffmpeg() noexcept { av_log_set_level(AV_LOG_QUIET); }

}  // namespace thermal
