#include "io/calibration_storage.h"

#include <algorithm>

#include <fmt/format.h>
#include <opencv2/core/utility.hpp>

#include "io/calibration_syntax.h"
#include "io/json_file.h"

namespace thermal {
namespace {

// One level of nesting takes at most 400 bytes of stack (OpenCV 4.6), so this many take 2 MB of the usual 8.
constexpr std::ptrdiff_t kMostMarks = 4000;

bool is_control(char letter) noexcept {
  const auto code = static_cast<unsigned char>(letter);
  return (code < ' ' && letter != '\n' && letter != '\r' && letter != '\t') || code == 0x7F;
}

/// How many characters a level of nesting can begin with: no text nests deeper than that.
std::ptrdiff_t count_marks(std::string_view text) {
  std::ptrdiff_t marks = std::ranges::count_if(
      text, [](char letter) { return letter == '[' || letter == '{' || letter == '<' || letter == ':'; });
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    const char next = text[i + 1];
    if (text[i] == '-' && (next == ' ' || next == '\n' || next == '\r' || next == '\t')) ++marks;
  }
  return marks;
}

void check_text(std::string_view text, const std::string& name) {
  if (text.size() > kMostCalibrationBytes) {
    throw ConfigError(fmt::format("{}: more than {} bytes; expected at most that many in a calibration", name,
                                  kMostCalibrationBytes));
  }
  if (std::ranges::any_of(text, is_control))
    throw ConfigError(name + ": control characters; expected a text: YAML, XML or JSON");
  for (const std::string_view word : {"!!binary", "$base64$", "\"binary\""}) {
    if (text.find(word) != std::string_view::npos)
      throw ConfigError(fmt::format("{}: {}; expected numbers in plain text", name, word));
  }
  if (count_marks(text) > kMostMarks) {
    throw ConfigError(fmt::format(
        "{}: more than {} brackets, tags and keys; expected a calibration of one camera", name, kMostMarks));
  }
}

/// A list's entries may stand below their key without being further in. OpenCV does not take that, so they are moved.
std::string with_lists_indented(std::string_view text) {
  std::string indented;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    const std::string_view line = text.substr(begin, end - begin);
    const std::size_t first = line.find_first_not_of(' ');
    if (first != std::string_view::npos && line.substr(first).starts_with("- ")) indented += "  ";
    indented += line;
    begin = end;
  }
  return indented;
}

/// A text that OpenCV reads without harm: checked, and with the header that OpenCV knows a format by.
std::string made_safe(std::string_view text, const std::string& name) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // byte-order mark
  const std::size_t first = std::min(text.find_first_not_of(" \r\n"), text.size());
  if (text.substr(first).starts_with('{')) return parse_json(text, name).dump(1, ' ', true);
  if (text.substr(first).starts_with('<')) {
    check_xml(text.substr(first), name);
    return std::string(text.substr(first));
  }
  check_yaml(text, name);
  text.remove_prefix(first);
  if (text.starts_with("%YAML")) return std::string(text) + "\n";
  return (text.starts_with("---") ? "%YAML:1.0\n" : "%YAML:1.0\n---\n") + with_lists_indented(text) + "\n";
}

int say_nothing(int /*status*/, const char* /*function*/, const char* /*message*/, const char* /*file*/,
                int /*line*/, void* /*data*/) {
  return 0;
}

/// OpenCV's own, where it has any.
std::string words_of(const std::exception& error) {
  const auto* opencv = dynamic_cast<const cv::Exception*>(&error);
  if (opencv == nullptr) return "not well-formed";
  // Of a text that is not well-formed, the words are where OpenCV has the function's name: "(LINE): Words".
  const std::size_t words = opencv->func.rfind("): ");
  const bool is_parsing = opencv->code == cv::Error::StsParseError && words != std::string::npos;
  return is_parsing ? opencv->func.substr(words + 3) : opencv->err;
}

}  // namespace

cv::FileStorage open_storage(std::string_view text, const std::string& name) {
  check_text(text, name);
  const std::string safe = made_safe(text, name);
  try {
    return {safe, cv::FileStorage::READ | cv::FileStorage::MEMORY};
  } catch (const std::exception& error) {  // std::length_error for a key without letters, too
    throw unreadable(error, name);
  }
}

ConfigError unreadable(const std::exception& error, const std::string& name) {
  return ConfigError(
      fmt::format("{}: {}; expected OpenCV's YAML, XML or JSON, or ROS' camera_info", name, words_of(error)));
}

QuietOpenCv::QuietOpenCv() noexcept : before_(cv::redirectError(say_nothing, nullptr, &before_data_)) {}

QuietOpenCv::~QuietOpenCv() { cv::redirectError(before_, before_data_); }

}  // namespace thermal
