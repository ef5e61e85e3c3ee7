#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/system/files.h"

namespace thermal {

/// Position of the frame number in a file's name; no digits if there is none.
struct NumberPosition {
  std::size_t at = 0;
  std::size_t digits = 0;

  [[nodiscard]] bool operator==(const NumberPosition&) const = default;
};

/// A pattern for names of files in one folder: * matches any characters, ? one, and one run of #, or one %d or %06d, the
/// frame's number. A number has as many digits as the pattern, padded with zeros, or more without leading zeros.
/// Every other character matches itself, case-sensitively.
class NamePattern {
 public:
  /// ConfigError, starting with `where`, for invalid patterns: several numbers, other % sequences, a folder, over 255
  /// characters.
  NamePattern(std::string_view text, std::string_view where);

  /// Whether it contains a wildcard or a number.
  [[nodiscard]] static bool has_wildcards(std::string_view name) noexcept;

  /// Empty for a name that does not match; if a number can start at several places, the first of them. Takes time of
  /// at most the product of both lengths.
  [[nodiscard]] std::optional<NumberPosition> match(std::string_view name) const;

 private:
  enum class Kind { letter, any_letter, any_letters, number };
  struct Piece {
    Kind kind = Kind::letter;
    char letter = 0;
    std::size_t digits = 0;
  };
  struct Reader;

  /// Number of characters that a piece can take: from `least` to `most`.
  struct Range {
    std::size_t least = 0;
    std::size_t most = 0;
    bool none = false;
  };
  /// [k][i]: the pieces from k on match the name from character i on.
  using Fits = std::vector<std::vector<bool>>;

  [[nodiscard]] static Range takes(const Piece& piece, std::string_view rest) noexcept;
  [[nodiscard]] std::optional<std::size_t> length_at(const Fits& fits, std::string_view name, std::size_t k,
                                                     std::size_t i) const;
  [[nodiscard]] Fits fits_of(std::string_view name) const;

  std::vector<Piece> pieces_;
};

/// The name of a frame's file, and the position of the frame's number in it, if a pattern gives it.
struct FrameName {
  std::string name;
  NumberPosition number = {};  ///< no digits: unknown
};

/// Files of a clip in order. Frames are ordered by the number in their names and spaced by the greatest common step;
/// steps without a file are gaps.
struct FrameSequence {
  /// A step of a sequence.
  struct Frame {
    FrameName name;  ///< for a gap: the name it would have
    bool is_gap = false;
  };
  std::vector<Frame> frames;
  std::int64_t step = 1;  ///< between numbers; 1 without numbers

  [[nodiscard]] int gaps() const noexcept;
};

/// Sorts files. If the position of a name's number is unknown, it is the last run of digits, before the extension,
/// that is not the same in all names. Names without digits are sorted as texts, without gaps. Repeated names count
/// once. DataError, starting with `where`, if some names have digits and others do not, two have one number, a number
/// has over 18 digits, or there would be more than ten gaps per file.
[[nodiscard]] FrameSequence sequence_of(std::vector<FrameName> names, const std::string& where);

/// A pattern that matches all these names, with # for the number; empty if there is none.
[[nodiscard]] std::string pattern_of(const FrameSequence& sequence);

/// Files of a folder, by name, without hidden ones. IoError with the folder if it cannot be read.
[[nodiscard]] std::vector<std::string> files_in(const Path& folder);

/// Those that match a pattern.
[[nodiscard]] std::vector<FrameName> names_matching(const NamePattern& pattern,
                                                    const std::vector<std::string>& names);

/// Those that are passes: .exr files, or .png files if there are none; extensions in any case.
[[nodiscard]] std::vector<FrameName> passes_among(const std::vector<std::string>& names);

}  // namespace thermal
