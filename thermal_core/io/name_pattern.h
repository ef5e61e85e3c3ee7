#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace thermal {

/// Where in a file's name its number is; none has no digits.
struct NumberPlace {
  std::size_t at = 0;
  std::size_t digits = 0;

  [[nodiscard]] bool operator==(const NumberPlace&) const = default;
};

/// A pattern of the names of files in one folder: * stands for any letters, ? for one, and one run of #, or one %d or
/// %06d, for the frame's number. A number has as many digits as the pattern, filled up with zeros, or more of them with
/// no zero before them. Every other letter is itself, in its own case.
class NamePattern {
 public:
  /// ConfigError, `where` before it, for what can't be meant: several numbers, another % than these, a folder, over 255 letters.
  NamePattern(std::string_view text, std::string_view where);

  /// Whether it holds a letter that patterns give a meaning.
  [[nodiscard]] static bool has_wildcards(std::string_view name) noexcept;

  /// Nothing for a name that does not match; where a number can begin in several places, the first of them.
  /// Takes at most the product of both lengths.
  [[nodiscard]] std::optional<NumberPlace> match(std::string_view name) const;

 private:
  enum class Kind { letter, any_letter, any_letters, number };
  struct Piece {
    Kind kind = Kind::letter;
    char letter = 0;
    std::size_t digits = 0;
  };
  struct Reader;

  /// How many letters of `rest` a piece can take: each number of them from `least` to `most`.
  struct Range {
    std::size_t least = 0;
    std::size_t most = 0;
    bool none = false;
  };
  /// [k][i]: the pieces from k on match the name from its letter i on.
  using Fits = std::vector<std::vector<bool>>;

  [[nodiscard]] static Range takes(const Piece& piece, std::string_view rest) noexcept;
  [[nodiscard]] std::optional<std::size_t> length_at(const Fits& fits, std::string_view name, std::size_t k,
                                                     std::size_t i) const;
  [[nodiscard]] Fits fits_of(std::string_view name) const;

  std::vector<Piece> pieces_;
};

}  // namespace thermal
