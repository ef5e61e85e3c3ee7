#include "io/video/ffmpeg.h"

#include <cerrno>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "io/system/c_locale.h"

extern "C" {
#include <libavutil/opt.h>
}

namespace thermal::ffmpeg {
namespace {

int ask(void* interrupted) { return (*static_cast<std::function<bool()>*>(interrupted))() ? 1 : 0; }

}  // namespace

H264Writer::H264Writer(Container container, const H264Settings& settings, Fault fault,
                       std::function<bool()>* interrupted)
    : container_(std::move(container)), fault_(std::move(fault)) {
  open_encoder(settings);
  open_container(settings, interrupted);
}

void H264Writer::open_encoder(const H264Settings& settings) {
  const AVCodec* codec = avcodec_find_encoder_by_name("libx264");
  encoder_.reset(codec == nullptr ? nullptr : avcodec_alloc_context3(codec));
  check(encoder_ ? 0 : AVERROR_ENCODER_NOT_FOUND);
  encoder_->log_level_offset = kSilent;
  encoder_->width = even(settings.width_px);
  encoder_->height = even(settings.height_px);
  encoder_->pix_fmt = AV_PIX_FMT_YUV420P;  // supported by every browser
  encoder_->framerate = av_d2q(settings.frame_rate_hz, 100000);
  encoder_->time_base = av_inv_q(encoder_->framerate);
  if (container_.global_header) encoder_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  encoder_->thread_count = settings.threads;
  check(av_opt_set(encoder_->priv_data, "preset", settings.preset.c_str(), 0));
  check(av_opt_set_int(encoder_->priv_data, "crf", settings.quality, 0));
  if (container_.live) {
    encoder_->gop_size = std::max(1, static_cast<int>(std::lround(settings.frame_rate_hz)));
    check(av_opt_set(encoder_->priv_data, "tune", "zerolatency", 0));
  }
  const CLocale numbers;  // for the text of x264's settings in the video
  check(avcodec_open2(encoder_.get(), codec, nullptr));
  picture_->format = encoder_->pix_fmt;
  picture_->width = encoder_->width;
  picture_->height = encoder_->height;
  check(av_frame_get_buffer(picture_.get(), 0));
}

void H264Writer::open_container(const H264Settings& settings, std::function<bool()>* interrupted) {
  AVFormatContext* made = nullptr;
  check(avformat_alloc_output_context2(&made, nullptr, container_.format.c_str(), container_.url.c_str()));
  format_.reset(made);
  format_->flags |= AVFMT_FLAG_BITEXACT;  // no name of a library's version in the file
  if (interrupted != nullptr) format_->interrupt_callback = {.callback = ask, .opaque = interrupted};
  if (container_.live) {
    format_->flags |= AVFMT_FLAG_FLUSH_PACKETS;
    format_->max_delay = 0;
  }
  if ((format_->oformat->flags & AVFMT_NOFILE) == 0)
    check(avio_open2(&format_->pb, container_.url.c_str(), AVIO_FLAG_WRITE, &format_->interrupt_callback,
                     nullptr));
  AVStream* stream = avformat_new_stream(format_.get(), nullptr);
  check(stream == nullptr ? AVERROR(ENOMEM) : 0);
  stream->time_base = encoder_->time_base;
  stream->avg_frame_rate = encoder_->framerate;
  check(avcodec_parameters_from_context(stream->codecpar, encoder_.get()));
  if (settings.streamable) check(av_opt_set(format_->priv_data, "movflags", "+faststart", 0));
  if (container_.format == "rtsp") check(av_opt_set(format_->priv_data, "rtsp_transport", "tcp", 0));
  check(avformat_write_header(format_.get(), nullptr));
  connected_ = container_.live;
}

H264Writer::~H264Writer() {
  if (connected_)
    av_write_trailer(format_.get());  // also needed to free memory if the trailer cannot be sent
}

void H264Writer::add(const std::function<void(const VideoPlanes&)>& draw, std::int64_t time) {
  check(av_frame_make_writable(picture_.get()));
  draw({.data = {picture_->data[0], picture_->data[1], picture_->data[2]},
        .stride_px = {picture_->linesize[0], picture_->linesize[1], picture_->linesize[2]},
        .width_px = picture_->width,
        .height_px = picture_->height});
  picture_->pts = time;
  encode(picture_.get());
}

/// `what` null: end of the stream.
void H264Writer::encode(const AVFrame* what) {
  check(avcodec_send_frame(encoder_.get(), what));
  for (;;) {
    const int result = avcodec_receive_packet(encoder_.get(), packet_.get());
    if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
    check(result);
    packet_->duration = 1;
    av_packet_rescale_ts(packet_.get(), encoder_->time_base, format_->streams[0]->time_base);
    check(container_.live ? av_write_frame(format_.get(), packet_.get())
                          : av_interleaved_write_frame(format_.get(), packet_.get()));
    av_packet_unref(packet_.get());
  }
}

void H264Writer::close() {
  encode(nullptr);
  connected_ = false;
  check(av_write_trailer(format_.get()));
  if (format_->pb != nullptr) check(avio_closep(&format_->pb));
}

}  // namespace thermal::ffmpeg
