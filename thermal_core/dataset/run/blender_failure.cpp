#include "dataset/run/blender_failure.h"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "base/printable.h"
#include "base/text.h"

namespace thermal {
namespace {

constexpr std::uintmax_t kMostReadBytes = 65536;
constexpr std::size_t kMostLines = 3;
constexpr std::size_t kLongestLineBytes = 200;

std::string tail_of(const Path& log, std::uintmax_t from) {
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(log, none);
  if (none || size <= from) return "";
  std::ifstream file(log, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(size - std::min(size - from, kMostReadBytes)));
  return {std::istreambuf_iterator<char>(file), {}};
}

bool says_something(std::string_view line) {
  return line.find_first_not_of(" \t\r") != std::string_view::npos && line != "Blender quit";
}

}  // namespace

std::string ReportedFailure::in_words() const {
  return message + (where.empty() ? "" : " (" + where + ")") + (hint.empty() ? "" : "; " + hint);
}

ReportedFailure reported_failure(const Json& event) {
  const auto text = [&event](const char* field, const char* otherwise) {
    return printable(event.value(field, std::string(otherwise)));
  };
  return {.message = text("message", "unknown reason"),
          .where = text("where", ""),
          .hint = text("hint", ""),
          .config = text("kind", "") == "config"};
}

std::string last_error_line_in(const Path& log, std::uintmax_t from) {
  const std::string tail = tail_of(log, from);
  std::vector<std::string> last;
  for (const std::string_view line : split(tail, '\n')) {
    if (says_something(line)) last.push_back(printable(line.substr(0, kLongestLineBytes)));
  }
  const std::size_t left_out = last.size() - std::min(last.size(), kMostLines);
  return fmt::format("{}",
                     fmt::join(last.begin() + static_cast<std::ptrdiff_t>(left_out), last.end(), " / "));
}

std::string unreported_end(const ExitStatus& status, const std::string& doing,
                           const std::string& last_error_line) {
  const std::string how = status.signal == 0 && status.code == 0 ? "ended early" : status.in_words();
  std::string end = fmt::format("Blender {} while {}", how, doing);
  if (status.signal == SIGKILL) return fmt::format("{}; {}", end, kKilledHint);
  if (status.is_killed()) return end;
  return end + (last_error_line.empty() ? "; it printed nothing" : ": " + last_error_line);
}

}  // namespace thermal
