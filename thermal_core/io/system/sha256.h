#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace thermal {

/// SHA-256 of bytes given piece by piece.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;

  void add(std::span<const std::byte> bytes);
  void add(std::string_view text);
  /// The sum as 64 lower-case hexadecimal digits; ends the sum.
  [[nodiscard]] std::string hex();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// SHA-256 in 64 hexadecimal digits.
[[nodiscard]] std::string sha256_of(std::span<const std::byte> bytes);
/// The same of a text.
[[nodiscard]] std::string sha256_of(std::string_view text);

/// Encodes bytes as base64: RFC 4648, section 4, padded.
[[nodiscard]] std::string base64_of(std::string_view bytes);

}  // namespace thermal
