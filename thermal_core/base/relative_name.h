#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace thermal {

/// A name read from a file, checked before it becomes part of a path: a relative path of printable UTF-8 whose parts,
/// separated by "/", have 1 to 200 bytes each and 4096 in all, are neither "." nor "..", and do not begin with "-". The
/// same holds for what Windows makes of it, where "\" separates parts too; it does not begin with a drive such as "C:".
/// Whatever it is appended to, the path leads below that folder, unless there are symbolic links in it.
class RelativeName {
 public:
  static constexpr std::size_t kMostBytes = 4096;
  static constexpr std::size_t kMostPartBytes =
      200;  ///< file systems take 255; ours append ".part" and the like
  static constexpr const char* kRule =
      "a relative path without \"..\", control characters, or parts that begin with \"-\" or exceed 200 "
      "bytes";
  static constexpr const char* kPartRule =
      "a name of at most 200 bytes without \"/\" or control characters that does not begin with \"-\"";

  /// Empty if the text is not such a path.
  [[nodiscard]] static std::optional<RelativeName> of(std::string_view text);
  /// The same for a path of one part: the name of a file or a folder.
  [[nodiscard]] static std::optional<RelativeName> part_of(std::string_view text);

  [[nodiscard]] const std::string& text() const noexcept { return text_; }

  [[nodiscard]] bool operator==(const RelativeName&) const = default;

 private:
  explicit RelativeName(std::string_view text) : text_(text) {}

  std::string text_;
};

}  // namespace thermal
