#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

struct libdeflate_decompressor;

namespace thermal {

/// Inflates chunks of EXR files compressed with ZIP or ZIPS. Its memory is reused.
class ExrInflater {
 public:
  ExrInflater();
  ~ExrInflater();
  ExrInflater(const ExrInflater&) = delete;
  ExrInflater& operator=(const ExrInflater&) = delete;

  /// Fills `bytes`; false if the chunk does not hold exactly as many, or out of memory.
  /// Source: Technical Introduction to OpenEXR, ZIP: differences of neighbouring bytes, first all even bytes, then
  /// all odd ones, deflated.
  [[nodiscard]] bool inflate(std::span<const std::byte> packed, std::span<std::byte> bytes) noexcept;

 private:
  [[nodiscard]] bool reserve(std::size_t size) noexcept;

  struct Free {
    void operator()(libdeflate_decompressor* decompressor) const noexcept;
  };
  std::unique_ptr<libdeflate_decompressor, Free> decompressor_;
  std::vector<std::byte> halves_;  ///< even bytes, then odd ones
};

}  // namespace thermal
