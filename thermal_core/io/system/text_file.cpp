#include "io/system/text_file.h"

#include <sstream>

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {
namespace {

void check_size(const Path& file, std::uintmax_t bytes, std::size_t most_bytes) {
  if (bytes <= most_bytes) return;
  throw IoError(fault(file.string(), fmt::format("{}", bytes), "bytes",
                      fmt::format("at most {} bytes ({} MiB)", most_bytes, most_bytes >> 20)));
}

}  // namespace

std::string read_text_file(const Path& file, std::size_t most_bytes) {
  check_is_file(file);
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  if (!error) check_size(file, bytes, most_bytes);
  std::string content;
  read_pieces(file, [&](std::string_view piece) {
    check_size(file, content.size() + piece.size(),
               most_bytes);  // files grow, and those of /proc have no size
    content.append(piece);
  });
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (content.starts_with(kByteOrderMark)) content.erase(0, kByteOrderMark.size());
  return content;
}

void for_table_lines(const Path& file,
                     const std::function<void(const std::string&, const std::string&)>& take,
                     std::size_t most_bytes) {
  std::istringstream lines(read_text_file(file, most_bytes));
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty() || line.starts_with('#')) continue;
    take(line, fmt::format("{}:{}", file.string(), number));
  }
}

}  // namespace thermal
