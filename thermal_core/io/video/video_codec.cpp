#include "io/video/video_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

extern "C" {
#include <libavutil/opt.h>
}

#include "base/error.h"
#include "base/text.h"
#include "io/video/ffmpeg.h"

namespace thermal {
namespace {

/// FFmpeg's names for a codec.
struct VideoKind {
  const char* name;
  const char* encoder;
  const char* decoder;
  AVPixelFormat format;
};
// Motion JPEG is of full range by definition, which FFmpeg has in the format's name.
constexpr std::array<VideoKind, 3> kVideoKinds = {{{"h264", "libx264", "h264", AV_PIX_FMT_YUV420P},
                                                   {"mpeg4", "mpeg4", "mpeg4", AV_PIX_FMT_YUV420P},
                                                   {"mjpeg", "mjpeg", "mjpeg", AV_PIX_FMT_YUVJ420P}}};

constexpr std::uint8_t kNoVideoColour = 128;
constexpr int kMostOfRate = 65535;  // MPEG-4 Part 2 has 16 bits for the time base

bool is_video_kind_installed(const VideoKind& kind) {
  return avcodec_find_encoder_by_name(kind.encoder) != nullptr &&
         avcodec_find_decoder_by_name(kind.decoder) != nullptr;
}

const VideoKind& find_video_kind(const std::string& name) {
  const auto* const found =
      std::ranges::find_if(kVideoKinds, [&](const VideoKind& kind) { return kind.name == name; });
  if (found != kVideoKinds.end() && is_video_kind_installed(*found)) return *found;
  const std::vector<std::string> installed = installed_video_codecs();
  throw ConfigError(
      fault("output.codec.name", fmt::format("\"{}\"", name), "",
            fmt::format("a codec that the installed FFmpeg {} encodes and decodes: {}", av_version_info(),
                        installed.empty() ? "it has none" : list_names(installed))));
}

/// Replicates the last row and column beyond the frame.
void fill_video_picture(const Plane<std::uint8_t>& frame, AVFrame& picture) {
  for (int y = 0; y < picture.height; ++y) {
    const auto row = frame.row(std::min(y, frame.height_px() - 1));
    std::uint8_t* const to = picture.data[0] + static_cast<std::ptrdiff_t>(y) * picture.linesize[0];
    std::ranges::copy(row, to);
    std::fill(to + row.size(), to + picture.width, row.back());
  }
  for (const std::size_t plane : {1U, 2U})
    std::fill_n(picture.data[plane], picture.linesize[plane] * (picture.height / 2), kNoVideoColour);
}

void copy_video_picture(const AVFrame& picture, Plane<std::uint8_t>& frame) {
  for (int y = 0; y < frame.height_px(); ++y) {
    const auto row = frame.row(y);
    std::memcpy(row.data(), picture.data[0] + static_cast<std::ptrdiff_t>(y) * picture.linesize[0],
                row.size());
  }
}

void check_video_call(int result) {
  if (result < 0) throw IoError(fmt::format("the video codec failed: {}", ffmpeg::reason_of(result)));
}

}  // namespace

struct VideoCodec::Impl {
  VideoCodecSettings settings;
  ffmpeg::Codec encoder;
  ffmpeg::Codec decoder;
  ffmpeg::Picture picture{av_frame_alloc()};
  ffmpeg::Picture decoded{av_frame_alloc()};
  ffmpeg::Packet packet{av_packet_alloc()};

  /// Makes bits independent of the number of cores and, for FFmpeg's own codecs, of the processor.
  static void make_repeatable(AVCodecContext& codec) {
    codec.log_level_offset = ffmpeg::kSilent;
    codec.thread_count = 1;
    codec.flags |= AV_CODEC_FLAG_BITEXACT;
    codec.dct_algo = FF_DCT_INT;
    codec.idct_algo = FF_IDCT_SIMPLE;
  }

  void open(ffmpeg::Codec& codec, const AVCodec* kind) const {
    const int result = avcodec_open2(codec.get(), kind, nullptr);
    if (result >= 0) return;
    const std::string what = fmt::format("\"{}\" with {} kbit/s", settings.name, settings.bitrate_kbit_s);
    throw ConfigError(fault("output.codec", what, "",
                            fmt::format("what the codec takes for {} x {} px: {}", encoder->width,
                                        encoder->height, ffmpeg::reason_of(result))));
  }

  void open_encoder(const VideoKind& kind, double frame_rate_hz, int width_px, int height_px) {
    const AVCodec* codec = avcodec_find_encoder_by_name(kind.encoder);
    encoder.reset(avcodec_alloc_context3(codec));
    make_repeatable(*encoder);
    encoder->width = ffmpeg::even(width_px);
    encoder->height = ffmpeg::even(height_px);
    encoder->pix_fmt = kind.format;
    encoder->color_range = AVCOL_RANGE_JPEG;
    encoder->framerate = av_d2q(frame_rate_hz, kMostOfRate);
    encoder->time_base = av_inv_q(encoder->framerate);
    encoder->gop_size = std::max(1, static_cast<int>(std::lround(frame_rate_hz)));
    encoder->max_b_frames = 0;
    set_rate(frame_rate_hz);
    if (settings.name == "h264") {
      check_video_call(av_opt_set(encoder->priv_data, "preset", "veryfast", 0));
      check_video_call(av_opt_set(encoder->priv_data, "tune", "zerolatency", 0));
      check_video_call(av_opt_set(encoder->priv_data, "x264-params", "cpu-independent=1", 0));
    } else {
      encoder->qmin = 1;  // FFmpeg's own codecs otherwise use at least 2, regardless of the rate
      encoder->mb_lmin = FF_QP2LAMBDA;
      check_video_call(av_opt_set_int(encoder->priv_data, "lmin", FF_QP2LAMBDA, 0));
    }
    open(encoder, codec);
  }

  /// Limits the rate over a buffer of a second, as for a radio link.
  void set_rate(double frame_rate_hz) const {
    const double share = settings.bitrate_at_hz > 0 ? frame_rate_hz / settings.bitrate_at_hz : 1;
    encoder->bit_rate = std::max(1000LL, std::llround(1e3 * share * settings.bitrate_kbit_s));
    encoder->rc_max_rate = encoder->bit_rate;
    constexpr double kMostBits = 2e9;
    encoder->rc_buffer_size = static_cast<int>(
        std::min(kMostBits, static_cast<double>(encoder->bit_rate) * std::max(1.0, 2 / frame_rate_hz)));
  }

  void open_decoder(const VideoKind& kind) {
    const AVCodec* codec = avcodec_find_decoder_by_name(kind.decoder);
    decoder.reset(avcodec_alloc_context3(codec));
    make_repeatable(*decoder);
    decoder->flags |= AV_CODEC_FLAG_LOW_DELAY;
    open(decoder, codec);
  }

  void make_picture() const {
    picture->format = encoder->pix_fmt;
    picture->color_range = encoder->color_range;
    picture->width = encoder->width;
    picture->height = encoder->height;
    picture->pts = 0;
    check_video_call(av_frame_get_buffer(picture.get(), 0));
  }
};

VideoCodec::VideoCodec(const VideoCodecSettings& settings, double frame_rate_hz, int width_px, int height_px)
    : impl_(std::make_unique<Impl>()) {
  const VideoKind& kind = find_video_kind(settings.name);
  impl_->settings = settings;
  impl_->open_encoder(kind, frame_rate_hz, width_px, height_px);
  impl_->open_decoder(kind);
  impl_->make_picture();
}

VideoCodec::~VideoCodec() = default;
VideoCodec::VideoCodec(VideoCodec&&) noexcept = default;
VideoCodec& VideoCodec::operator=(VideoCodec&&) noexcept = default;

std::size_t VideoCodec::pass(Plane<std::uint8_t>& frame) {
  Impl& codec = *impl_;
  check_video_call(av_frame_make_writable(codec.picture.get()));
  fill_video_picture(frame, *codec.picture);
  check_video_call(avcodec_send_frame(codec.encoder.get(), codec.picture.get()));
  check_video_call(avcodec_receive_packet(codec.encoder.get(), codec.packet.get()));
  check_video_call(avcodec_send_packet(codec.decoder.get(), codec.packet.get()));
  check_video_call(avcodec_receive_frame(codec.decoder.get(), codec.decoded.get()));
  copy_video_picture(*codec.decoded, frame);
  ++codec.picture->pts;
  return static_cast<std::size_t>(codec.packet->size);
}

std::vector<std::string> installed_video_codecs() {
  std::vector<std::string> names;
  for (const VideoKind& kind : kVideoKinds) {
    if (is_video_kind_installed(kind)) names.emplace_back(kind.name);
  }
  return names;
}

void check_video_codec(const VideoCodecSettings& settings, double frame_rate_hz, int width_px,
                       int height_px) {
  const VideoCodec opened(settings, frame_rate_hz, width_px, height_px);
}

}  // namespace thermal
