#include "io/exr/decode.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>

#include <libdeflate.h>
#include <openexr.h>

#include "base/error.h"

namespace thermal {
namespace {

constexpr std::uint64_t kHighBits = 0x8080808080808080U;
constexpr std::uint64_t kOnes = 0x0101010101010101U;

/// Sums of eight pairs of bytes, each modulo 256.
std::uint64_t add_bytes(std::uint64_t a, std::uint64_t b) noexcept {
  return ((a & ~kHighBits) + (b & ~kHighBits)) ^ ((a ^ b) & kHighBits);
}

/// Replaces each byte but the first by the sum of all bytes up to it, minus 128 per step; eight at a time.
void sum_differences(std::span<std::byte> bytes) noexcept {
  auto sum = std::to_integer<std::uint64_t>(bytes.front());
  std::size_t i = 1;
  for (; i + 8 <= bytes.size(); i += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, &bytes[i], 8);
    eight ^= kHighBits;  // less 128
    eight = add_bytes(eight, eight << 8U);
    eight = add_bytes(eight, eight << 16U);
    eight = add_bytes(eight, eight << 32U);
    eight = add_bytes(eight, sum * kOnes);
    std::memcpy(&bytes[i], &eight, 8);
    sum = eight >> 56U;
  }
  for (; i < bytes.size(); ++i) {
    sum = (sum + std::to_integer<std::uint64_t>(bytes[i]) + 128) & 0xFFU;
    bytes[i] = static_cast<std::byte>(sum);
  }
}

/// Even bytes from the first half, odd ones from the second; with an odd count the last is in the first half.
void join_halves(std::span<const std::byte> halves, std::byte* out) noexcept {
  const std::size_t pairs = halves.size() / 2;
  const std::byte* const even = halves.data();
  const std::byte* const odd = even + (halves.size() + 1) / 2;
  for (std::size_t i = 0; i < pairs; ++i) {
    out[2 * i] = even[i];
    out[2 * i + 1] = odd[i];
  }
  if (halves.size() % 2 == 1) out[2 * pairs] = even[pairs];
}

}  // namespace

void ExrInflater::Free::operator()(libdeflate_decompressor* decompressor) const noexcept {
  libdeflate_free_decompressor(decompressor);
}

ExrInflater::ExrInflater() = default;
ExrInflater::~ExrInflater() = default;

bool ExrInflater::reserve(std::size_t size) noexcept {
  try {
    if (!decompressor_) decompressor_.reset(libdeflate_alloc_decompressor());
    halves_.resize(size);
  } catch (const std::bad_alloc&) {
    return false;
  }
  return decompressor_ != nullptr;
}

bool ExrInflater::inflate(std::span<const std::byte> packed, std::span<std::byte> bytes) noexcept {
  if (bytes.empty()) return false;
  std::size_t written = 0;
  const libdeflate_result result = libdeflate_zlib_decompress(
      decompressor_.get(), packed.data(), packed.size(), halves_.data(), halves_.size(), &written);
  if (result != LIBDEFLATE_SUCCESS || written != bytes.size()) return false;
  sum_differences(halves_);
  join_halves(halves_, bytes.data());
  return true;
}

namespace {

constexpr int kBytesAPixel = 4;

/// An opened file, and the library's last message.
class Context {
 public:
  explicit Context(const Path& file) {
    exr_context_initializer_t settings{};
    settings.size = sizeof(settings);
    settings.user_data = &said_;
    settings.error_handler_fn = remember;
    const exr_result_t result = exr_start_read(&context_, file.c_str(), &settings);
    if (result != EXR_ERR_SUCCESS) fail(result);
  }
  ~Context() { exr_finish(&context_); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  [[nodiscard]] exr_context_t get() const noexcept { return context_; }

  void check(exr_result_t result) const {
    if (result != EXR_ERR_SUCCESS) fail(result);
  }

 private:
  static void remember(exr_const_context_t context, exr_result_t /*code*/, const char* message) {
    void* said = nullptr;
    if (exr_get_user_data(context, &said) == EXR_ERR_SUCCESS && said != nullptr)
      *static_cast<std::string*>(said) = message;
  }

  [[noreturn]] void fail(exr_result_t result) const {
    if (result == EXR_ERR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw IoError(said_.empty() ? exr_get_default_error_message(result) : said_);
  }

  std::string said_;
  exr_context_t context_ = nullptr;
};

/// Decodes one part into the targets, chunk by chunk.
class PartDecoder {
 public:
  PartDecoder(const Context& context, int part, std::span<const ChannelTarget> targets)
      : context_(context), part_(part), targets_(targets) {
    context_.check(exr_get_data_window(context_.get(), part_, &window_));
  }
  ~PartDecoder() {
    if (started_) exr_decoding_destroy(context_.get(), &pipeline_);
  }
  PartDecoder(const PartDecoder&) = delete;
  PartDecoder& operator=(const PartDecoder&) = delete;

  void run() {
    exr_storage_t storage = EXR_STORAGE_SCANLINE;
    context_.check(exr_get_storage(context_.get(), part_, &storage));
    if (storage == EXR_STORAGE_TILED) {
      decode_tiles();
    } else {
      decode_scanlines();
    }
  }

 private:
  void decode_scanlines() {
    std::int32_t lines = 0;
    context_.check(exr_get_scanlines_per_chunk(context_.get(), part_, &lines));
    for (std::int64_t y = window_.min.y; y <= window_.max.y; y += lines) {
      exr_chunk_info_t chunk;
      context_.check(exr_read_scanline_chunk_info(context_.get(), part_, static_cast<int>(y), &chunk));
      decode(chunk, 0, y - window_.min.y);
    }
  }

  void decode_tiles() {
    std::int32_t width = 0;
    std::int32_t height = 0;
    context_.check(exr_get_tile_sizes(context_.get(), part_, 0, 0, &width, &height));
    const std::int64_t columns = (this->width() + width - 1) / width;
    const std::int64_t rows = (this->height() + height - 1) / height;
    for (std::int64_t row = 0; row < rows; ++row) {
      for (std::int64_t column = 0; column < columns; ++column) {
        exr_chunk_info_t chunk;
        context_.check(exr_read_tile_chunk_info(context_.get(), part_, static_cast<int>(column),
                                                static_cast<int>(row), 0, 0, &chunk));
        decode(chunk, column * width, row * height);
      }
    }
  }

  /// A chunk, and the first of its pixels in the data window.
  void decode(const exr_chunk_info_t& chunk, std::int64_t x, std::int64_t y) {
    if (started_) {
      context_.check(exr_decoding_update(context_.get(), part_, &chunk, &pipeline_));
    } else {
      context_.check(exr_decoding_initialize(context_.get(), part_, &chunk, &pipeline_));
    }
    aim(x, y);
    if (!started_) choose_routines(chunk);
    context_.check(exr_decoding_run(context_.get(), part_, &pipeline_));
  }

  void choose_routines(const exr_chunk_info_t& chunk) {
    started_ = true;
    context_.check(exr_decoding_choose_default_routines(context_.get(), part_, &pipeline_));
    if (chunk.compression != EXR_COMPRESSION_ZIP && chunk.compression != EXR_COMPRESSION_ZIPS) return;
    pipeline_.decoding_user_data = &inflater_;
    pipeline_.decompress_fn = inflate;
  }

  /// Sets destinations for a chunk's pixels; channels without a target are not unpacked.
  void aim(std::int64_t x, std::int64_t y) {
    for (int i = 0; i < pipeline_.channel_count; ++i) {
      exr_coding_channel_info_t& channel = pipeline_.channels[i];
      channel.decode_to_ptr = nullptr;
      for (const ChannelTarget& target : targets_) {
        if (target.channel != channel.channel_name) continue;
        channel.decode_to_ptr =
            static_cast<std::uint8_t*>(target.first) + y * target.bytes_a_line + x * kBytesAPixel;
        channel.user_pixel_stride = kBytesAPixel;
        channel.user_line_stride = target.bytes_a_line;
        channel.user_bytes_per_element = kBytesAPixel;
        channel.user_data_type = static_cast<std::uint16_t>(target.whole ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT);
      }
    }
  }

  /// Called from C, so it must not throw. The library has allocated memory for the bytes or, if they are not
  /// compressed, uses the bytes read.
  static exr_result_t inflate(exr_decode_pipeline_t* pipeline) noexcept {
    if (pipeline->unpacked_buffer == pipeline->packed_buffer) return EXR_ERR_SUCCESS;
    if (pipeline->unpacked_alloc_size < pipeline->chunk.unpacked_size) return EXR_ERR_CORRUPT_CHUNK;
    auto& inflater = *static_cast<ExrInflater*>(pipeline->decoding_user_data);
    if (!inflater.reserve(pipeline->chunk.unpacked_size)) return EXR_ERR_OUT_OF_MEMORY;
    const bool good = inflater.inflate(
        {static_cast<const std::byte*>(pipeline->packed_buffer), pipeline->chunk.packed_size},
        {static_cast<std::byte*>(pipeline->unpacked_buffer), pipeline->chunk.unpacked_size});
    return good ? EXR_ERR_SUCCESS : EXR_ERR_CORRUPT_CHUNK;
  }

  [[nodiscard]] std::int64_t width() const noexcept {
    return std::int64_t{window_.max.x} - window_.min.x + 1;
  }
  [[nodiscard]] std::int64_t height() const noexcept {
    return std::int64_t{window_.max.y} - window_.min.y + 1;
  }

  const Context& context_;
  int part_;
  std::span<const ChannelTarget> targets_;
  exr_attr_box2i_t window_{};
  exr_decode_pipeline_t pipeline_{};
  ExrInflater inflater_;
  bool started_ = false;
};

}  // namespace

bool can_decode(int compression) noexcept {
  return compression >= EXR_COMPRESSION_NONE && compression <= EXR_COMPRESSION_PXR24;
}

void decode_part(const Path& file, int part, std::span<const ChannelTarget> targets) {
  const Context context(file);
  PartDecoder(context, part, targets).run();
}

}  // namespace thermal
