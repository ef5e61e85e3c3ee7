#include "io/config/calibration_storage.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core/utility.hpp>

#include "base/error.h"
#include "base/text.h"
#include "io/json/file.h"

namespace thermal {
namespace {

bool is_space(char letter) noexcept { return letter == ' ' || letter == '\n' || letter == '\r'; }

bool is_name(char letter) noexcept {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
         (letter >= '0' && letter <= '9') || letter == '_' || letter == '-' || letter == '.';
}

/// Part of a word or number that stands without quotes.
bool is_plain(char letter) noexcept {
  return is_name(letter) || std::string_view(" +/():,").find(letter) != std::string_view::npos;
}

bool is_all(std::string_view text, bool (*is_one)(char) noexcept) {
  return std::ranges::all_of(text, is_one);
}

/// A text that is taken bit by bit from its beginning.
class Scanner {
 public:
  Scanner(std::string_view text, const std::string& name) : left_(text), whole_(text), name_(name) {}

  [[nodiscard]] bool done() const noexcept { return left_.empty(); }

  [[nodiscard]] bool take(std::string_view word) noexcept {
    if (!left_.starts_with(word)) return false;
    left_.remove_prefix(word.size());
    return true;
  }
  void need(std::string_view word) {
    if (!take(word)) fail(word);
  }
  /// All up to `end`, which is needed and goes, too.
  std::string_view take_until(std::string_view end) {
    const std::size_t size = left_.find(end);
    if (size == std::string_view::npos) fail(end);
    const std::string_view taken = left_.substr(0, size);
    left_.remove_prefix(size + end.size());
    return taken;
  }
  template <typename Is>
  std::string_view take_while(const Is& is) {
    const auto end = std::find_if_not(left_.begin(), left_.end(), is);
    const std::string_view taken = left_.substr(0, static_cast<std::size_t>(end - left_.begin()));
    left_.remove_prefix(taken.size());
    return taken;
  }
  std::string_view take_name() {
    const std::string_view taken = take_while(is_name);
    if (taken.empty()) fail("a name");
    return taken;
  }
  [[noreturn]] void fail(std::string_view rule) const {
    const std::string_view before = whole_.substr(0, whole_.size() - left_.size());
    throw ConfigError(fmt::format("{}:{}: expected {}", name_, 1 + std::ranges::count(before, '\n'), rule));
  }

 private:
  std::string_view left_;
  std::string_view whole_;
  const std::string& name_;
};

/// What stands between two tags: nothing, a string, or words and numbers.
void check_xml_value(std::string_view value, const Scanner& in) {
  while (!value.empty() && is_space(value.front())) value.remove_prefix(1);
  while (!value.empty() && is_space(value.back())) value.remove_suffix(1);
  const bool is_string = value.size() >= 2 && value.front() == '"' && value.back() == '"';
  const bool is_fine =
      is_string ? value.substr(1, value.size() - 2).find_first_of("\"\n\\") == std::string_view::npos
                : std::ranges::all_of(
                      value, [](char one) { return is_space(one) || is_plain(one) || one == '"'; }) &&
                      value.find("\"\"") == std::string_view::npos && std::ranges::count(value, '"') % 2 == 0;
  if (!is_fine) in.fail("numbers, words or a string between two tags");
}

/// A YAML text, line by line.
class Lines {
 public:
  explicit Lines(const std::string& name) : name_(name) {}

  void add(std::string_view line) {
    ++number_;
    while (!line.empty() && (line.back() == ' ' || line.back() == '\r')) line.remove_suffix(1);
    if (depth_ > 0) return add_to_list(line);
    const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
    line.remove_prefix(indent);
    if (line.empty() || line.front() == '#') return;
    if (indent == 0 && !begun_ && (line.starts_with("%YAML") || line == "---")) {
      if (!is_all(line.substr(1), [](char one) noexcept { return is_plain(one); })) fail("%YAML:1.0");
      return;
    }
    begun_ = true;
    const bool is_entry = line.starts_with("- ");
    take_indent(indent, is_entry);
    if (is_entry) return add_value(line.substr(2));
    const auto end = std::ranges::find_if_not(line, is_name);
    const auto key_size = static_cast<std::size_t>(end - line.begin());
    const std::string_view rest = line.substr(key_size);
    if (key_size == 0 || line.front() == '-' || !rest.starts_with(':') || (rest.size() > 1 && rest[1] != ' '))
      fail("key: value");
    add_value(rest.substr(1));
  }

  void end() const {
    if (depth_ > 0) fail("] where the list ends");
  }

 private:
  /// Lines of a list or of keys stand below each other. Others, OpenCV 4.6 may read for ever.
  void take_indent(std::size_t indent, bool is_entry) {
    const std::size_t place = 2 * indent + (is_entry ? 1 : 0);  // a list may stand right below its key
    if (open_.empty() && is_entry) fail("key: value");
    const bool is_new = open_.empty() || place > open_.back();
    if (is_new ? !value_may_follow_ : std::ranges::find(open_, place) == open_.end())
      fail("as many spaces as a line above has");
    while (!is_new && place < open_.back()) open_.pop_back();
    if (is_new) open_.push_back(place);
    value_may_follow_ = false;
  }

  void add_value(std::string_view value) {
    value.remove_prefix(std::min(value.find_first_not_of(' '), value.size()));
    if (const std::size_t comment = value.find(" #");
        comment != std::string_view::npos && !value.starts_with('"'))
      value = value.substr(0, comment);
    value_may_follow_ = value.empty() || value == "!!opencv-matrix";
    if (value_may_follow_) return;
    if (value.starts_with('[')) return add_to_list(value);
    const char quote = value.front();
    if (quote == '"' || quote == '\'') {
      const bool is_whole =
          value.size() >= 2 && value.find_first_of("\"'\\", 1) == value.size() - 1 && value.back() == quote;
      if (!is_whole) fail("a string in quotes, without others in it");
      return;
    }
    const bool is_fine = is_all(value, is_plain) &&
                         std::string_view(":,").find(quote) == std::string_view::npos &&
                         value.find(": ") == std::string_view::npos && value.back() != ':' &&
                         !(quote == '-' && (value.size() == 1 || value[1] == ' '));
    if (!is_fine) fail("a number, a word, a string in quotes, or a list in [ ]");
  }

  void add_to_list(std::string_view part) {
    constexpr int kDeepest = 4;
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (part[i] == '[' && ++depth_ > kDeepest) fail("lists less deep");
      if (part[i] == ']' && --depth_ == 0) {
        if (i + 1 < part.size()) fail("nothing behind the list");
        return;
      }
      const bool is_fine = part[i] == '[' || part[i] == ']' || (is_plain(part[i]) && part[i] != ':');
      if (!is_fine) fail("numbers and , in a list");
    }
  }

  [[noreturn]] void fail(std::string_view rule) const {
    throw ConfigError(fmt::format("{}:{}: expected {}", name_, number_, rule));
  }

  const std::string& name_;
  int number_ = 0;
  int depth_ = 0;  ///< of lists that have not ended
  bool begun_ = false;
  std::vector<std::size_t> open_;  ///< places of the lists and keys that have not ended
  bool value_may_follow_ = true;   ///< in lines further in
};

}  // namespace

void check_xml(std::string_view text, const std::string& name) {
  Scanner in(text, name);
  in.need("<?xml version=\"1.0\"");
  in.take_while(is_space);
  if (in.take("encoding=\"")) {
    in.take_name();
    in.need("\"");
  }
  in.take_while(is_space);
  in.need("?>");
  constexpr std::size_t kDeepest = 16;
  std::vector<std::string_view> open;
  bool ended = false;
  for (in.take_while(is_space); !in.done(); in.take_while(is_space)) {
    if (in.take("<!--")) {
      in.take_until("-->");
    } else if (in.take("</")) {
      if (open.empty() || in.take_name() != open.back()) in.fail("the end of the last tag that has none");
      open.pop_back();
      in.take_while(is_space);
      in.need(">");
      ended = open.empty();
    } else if (in.take("<")) {
      const std::string_view tag = in.take_name();
      if (ended || (open.empty() && tag != "opencv_storage")) in.fail("one <opencv_storage>");
      if (open.size() == kDeepest) in.fail("tags less deep");
      open.push_back(tag);
      in.take_while(is_space);
      if (in.take("type_id=\"")) {
        in.take_name();
        in.need("\"");
        in.take_while(is_space);
      }
      in.need(">");
    } else {
      const std::string_view value = in.take_while([](char one) { return one != '<'; });
      if (open.size() < 2) in.fail("a tag");
      check_xml_value(value, in);
    }
  }
  if (!ended) in.fail("</opencv_storage>");
}

void check_yaml(std::string_view text, const std::string& name) {
  Lines lines(name);
  for (const std::string_view line : split(text, '\n')) lines.add(line);
  lines.end();
}

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
