#include "io/config/calibration_tree.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

constexpr int kMostNested = 16;
constexpr std::size_t kMostShown = 60;  // of a key in a message

bool is_space(char letter) noexcept { return letter == ' ' || letter == '\n' || letter == '\r'; }

bool is_blank_in_line(char letter) noexcept { return letter == ' ' || letter == '\t' || letter == '\r'; }

bool is_decimal(char letter) noexcept { return letter >= '0' && letter <= '9'; }

bool is_name(char letter) noexcept {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || is_decimal(letter) ||
         letter == '_' || letter == '-' || letter == '.';
}

bool is_one_of(char letter, std::string_view letters) noexcept {
  return letters.find(letter) != std::string_view::npos;
}

/// A number, nothing, or else the word itself. 010 is a word: it is 8 in YAML 1.1, 10 in 1.2.
Json scalar_of(std::string_view word) {
  if (word.empty() || word == "~" || word == "null") return nullptr;
  std::string_view digits = word;
  const bool is_negative = digits.front() == '-';
  if (is_one_of(digits.front(), "+-")) digits.remove_prefix(1);
  const double sign = is_negative ? -1 : 1;
  const std::string special = lower_case(std::string(digits));
  if (special == ".nan") return std::numeric_limits<double>::quiet_NaN();
  if (special == ".inf") return sign * std::numeric_limits<double>::infinity();
  const bool begins = !digits.empty() && (is_decimal(digits.front()) || digits.front() == '.');
  if (!begins || (digits.size() > 1 && digits[0] == '0' && is_decimal(digits[1]))) return std::string(word);
  if (const auto whole = number_in<int>(digits)) return is_negative ? -*whole : *whole;
  if (const auto real = number_in<double>(digits)) return sign * *real;
  return std::string(word);
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

/// OpenCV's XML.
class Xml {
 public:
  Xml(std::string_view text, const std::string& name) : in_(text, name) {}

  Json read() {
    in_.need("<?xml version=\"1.0\"");
    in_.take_while(is_space);
    if (in_.take("encoding=\"")) {
      in_.take_name();
      in_.need("\"");
    }
    in_.take_while(is_space);
    in_.need("?>");
    skip();
    if (in_.done()) in_.fail("</opencv_storage>");
    if (!in_.take("<opencv_storage>")) in_.fail("one <opencv_storage>");
    Json root = content("opencv_storage", 1);
    skip();
    if (!in_.done()) in_.fail("one <opencv_storage>");
    return root;
  }

 private:
  void skip() {
    for (in_.take_while(is_space); in_.take("<!--"); in_.take_while(is_space)) in_.take_until("-->");
  }

  /// All up to the end of a tag, and the end: a map, a list of tags <_>, or numbers and words.
  Json content(std::string_view tag, int depth) {
    if (depth > kMostNested) in_.fail("tags less deep");
    Json found;
    for (skip(); !in_.take("</"); skip()) {
      if (in_.done()) in_.fail(fmt::format("</{}>", tag));
      if (in_.take("<")) {
        if (!found.is_null() && !found.is_structured()) in_.fail("either tags or values in a tag");
        add_tag(found, depth);
      } else {
        if (depth == 1 || !found.is_null()) in_.fail("a tag");
        found = values(in_.take_while([](char one) { return one != '<'; }));
      }
    }
    if (in_.take_name() != tag) in_.fail("the end of the last tag that has none");
    in_.take_while(is_space);
    in_.need(">");
    return found;
  }

  void add_tag(Json& found, int depth) {
    const std::string tag(in_.take_name());
    in_.take_while(is_space);
    if (in_.take("type_id=\"")) {
      in_.take_name();
      in_.need("\"");
      in_.take_while(is_space);
    }
    in_.need(">");
    const bool is_entry = tag == "_";
    if (found.is_null()) found = is_entry ? Json::array() : Json::object();
    if (found.is_array() != is_entry || (!is_entry && found.contains(tag))) in_.fail("each tag once");
    Json inner = content(tag, depth + 1);
    if (is_entry) {
      found.push_back(std::move(inner));
    } else {
      found[tag] = std::move(inner);
    }
  }

  /// What stands between two tags: one value, or a list.
  Json values(std::string_view text) {
    Json found = Json::array();
    while (true) {
      text.remove_prefix(std::min(text.find_first_not_of(" \r\n"), text.size()));
      if (text.empty()) break;
      const bool is_quoted = text.front() == '"';
      const std::size_t size = std::min(text.find_first_of(is_quoted ? "\"" : " \r\n", 1), text.size());
      const std::string_view word = text.substr(0, size).substr(is_quoted ? 1 : 0);
      if ((is_quoted && size == text.size()) || word.find_first_of("\"\\<>&\t\n") != std::string_view::npos)
        in_.fail("numbers, words or a string between two tags");
      if (is_quoted) {
        found.push_back(std::string(word));
      } else {
        found.push_back(scalar_of(word));
      }
      text.remove_prefix(size + (is_quoted ? 1 : 0));
    }
    return found.size() == 1 ? Json(found[0]) : found;
  }

  Scanner in_;
};

/// The part of YAML that calibrations are written in.
class Yaml {
 public:
  Yaml(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  Json read() {
    next_line();
    while (at_column_0("%")) {
      if (!left().starts_with("%YAML")) fail("no directive but %YAML");
      skip_line();
      next_line();
    }
    if (take_mark()) next_line();
    Json root;
    if (!done()) {
      if (is_one_of(text_[at_], "-[")) fail("key: value");
      root = node(column(), 1);
      if (!root.is_object()) fail("key: value");
    }
    next_line();
    while (take_mark()) next_line();
    if (!done()) fail(ended_ ? "one document, such as one message of a topic" : kIndent);
    return root;
  }

 private:
  static constexpr const char* kIndent = "as many spaces as a line above has";

  [[nodiscard]] bool done() const noexcept { return at_ == text_.size(); }
  [[nodiscard]] std::string_view left() const noexcept { return text_.substr(at_); }
  [[nodiscard]] char letter(std::size_t place) const noexcept {
    return place < text_.size() ? text_[place] : '\n';
  }
  [[nodiscard]] std::size_t column() const noexcept { return at_ - line_begin_; }
  [[nodiscard]] bool is_end(std::size_t place) const noexcept {
    return letter(place) == '\n' || is_blank_in_line(letter(place));
  }
  [[nodiscard]] bool at_column_0(std::string_view word) const noexcept {
    return column() == 0 && left().starts_with(word);
  }
  [[nodiscard]] bool is_entry() const noexcept { return letter(at_) == '-' && is_end(at_ + 1); }
  /// Between two documents.
  [[nodiscard]] bool is_mark() const noexcept {
    return (at_column_0("---") || at_column_0("...")) && is_end(at_ + 3);
  }

  bool take_mark() noexcept {
    if (!is_mark()) return false;
    at_ += 3;
    ended_ = begun_;
    return true;
  }

  void skip_line() noexcept { at_ = std::min(text_.find('\n', at_), text_.size()); }

  /// To what is next in this line; past a comment.
  void skip_blanks() noexcept {
    const std::size_t begin = at_;
    while (!done() && is_blank_in_line(text_[at_])) ++at_;
    if (letter(at_) == '#' && (at_ > begin || at_ == line_begin_)) skip_line();
  }

  /// To what is next in this line or those below.
  void next_line() {
    for (skip_blanks(); !done() && text_[at_] == '\n'; skip_blanks()) line_begin_ = ++at_;
    const std::string_view before = text_.substr(line_begin_, column());
    if (!done() && before.find('\t') != std::string_view::npos && is_all_blank(before))
      fail("spaces before a key, not tabs");
  }

  static bool is_all_blank(std::string_view text) { return std::ranges::all_of(text, is_blank_in_line); }

  /// A map, a list or a value that begins here.
  Json node(std::size_t indent, int depth) {
    if (depth > kMostNested) fail("lists less deep");
    begun_ = true;
    if (is_entry()) return list(indent, depth);
    const std::size_t begin = at_;
    Json first = value(depth);
    const bool is_key = letter(at_) == ':' && is_end(at_ + 1) && !first.is_structured();
    if (!is_key) {
      need_end(first);
      return first;
    }
    at_ = begin;
    return map(indent, depth);
  }

  Json map(std::size_t indent, int depth) {
    Json found = Json::object();
    do {
      if (is_entry()) fail("key: value");
      const std::string key = take_key();
      if (letter(at_) != ':' || !is_end(at_ + 1)) fail("key: value");
      add_key(found, key);
      ++at_;
      found[key] = map_value(indent, depth);
    } while (goes_on(indent));
    return found;
  }

  /// Behind a key: in its line, or further in below; a list may stand right below.
  Json map_value(std::size_t indent, int depth) {
    skip_blanks();
    constexpr std::string_view kMatrix = "!!opencv-matrix";
    if (left().starts_with(kMatrix) && is_end(at_ + kMatrix.size())) {
      at_ += kMatrix.size();
      skip_blanks();
    }
    if (letter(at_) != '\n') {
      if (is_entry()) fail(kValue);
      Json found = value(depth);
      need_end(found);
      return found;
    }
    next_line();
    const bool is_below = column() > indent || (column() == indent && is_entry());
    return done() || is_mark() || !is_below ? Json() : node(column(), depth + 1);
  }

  Json list(std::size_t indent, int depth) {
    Json found = Json::array();
    do {
      if (!is_entry()) break;  // the next key, for a list that stands right below its own
      ++at_;
      skip_blanks();
      if (letter(at_) == '\n') next_line();
      const bool is_empty = done() || is_mark() || column() <= indent;
      found.push_back(is_empty ? Json() : node(column(), depth + 1));
    } while (goes_on(indent));
    return found;
  }

  /// Whether the next line belongs to what is `indent` wide; those further out are left to what they belong to.
  bool goes_on(std::size_t indent) {
    next_line();
    if (done() || is_mark() || column() < indent) return false;
    if (column() > indent) fail(kIndent);
    return true;
  }

  void need_end(const Json& behind) {
    skip_blanks();
    if (letter(at_) == '\n') return;
    fail(behind.is_array()    ? "nothing behind the list"
         : behind.is_object() ? "nothing behind the map"
                              : kValue);
  }

  /// A list or map in brackets, a string in quotes, a number or a word.
  Json value(int depth) {
    const char first = letter(at_);
    if (first == '[') return flow_list(depth);
    if (first == '{') return flow_map(depth);
    if (is_one_of(first, "\"'")) return quoted();
    refuse_by_name(first);
    return scalar_of(word(""));
  }

  void refuse_by_name(char first) const {
    if (first == '&') fail("no anchor (&)");
    if (first == '*') fail("no alias (*)");
    if (first == '!') fail("no tag (!) but !!opencv-matrix");
    if (first == '|' || first == '>') fail(fmt::format("no block text ({})", first));
    if (first == '?') fail("no key of several lines (?)");
    if (is_one_of(first, "%@`,]}:")) fail(kValue);
  }

  std::string take_key() {
    if (is_one_of(letter(at_), "\"'")) return quoted();
    if (is_one_of(letter(at_), "[{:%@`,]}")) fail("key: value");
    refuse_by_name(letter(at_));
    return std::string(word(""));
  }

  void add_key(const Json& map, const std::string& key) const {
    if (key == "<<") fail("no merged keys (<<)");
    if (map.contains(key)) fail(fmt::format("{} once", printable(key.substr(0, kMostShown))));
  }

  /// Up to the end of the line, a comment, a colon behind a key, or one of `ends`.
  std::string_view word(std::string_view ends) noexcept {
    const std::size_t begin = at_;
    std::size_t end = at_;  // without blanks
    for (; letter(at_) != '\n'; ++at_) {
      const char one = text_[at_];
      if (is_one_of(one, ends) || (one == '#' && at_ > begin && is_blank_in_line(text_[at_ - 1]))) break;
      if (one == ':' && (is_end(at_ + 1) || is_one_of(letter(at_ + 1), ends))) break;
      if (!is_blank_in_line(one)) end = at_ + 1;
    }
    if (letter(at_) != ':') at_ = end;
    return text_.substr(begin, end - begin);
  }

  std::string quoted() {
    const char quote = text_[at_];
    const std::size_t end = text_.find_first_of("\"'\\\n", at_ + 1);
    if (end == std::string_view::npos || text_[end] != quote || letter(end + 1) == quote)
      fail("a string in quotes, without others in it");
    std::string found(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return found;
  }

  Json flow_list(int depth) {
    if (depth > kMostNested) fail("lists less deep");
    Json found = Json::array();
    ++at_;
    next_line();
    for (bool goes_on = letter(at_) != ']'; goes_on; goes_on = take_comma(']')) {
      if (done()) break;
      found.push_back(flow_value(depth + 1));
      next_line();
    }
    take_bracket(']', "numbers and , in a list");
    return found;
  }

  Json flow_map(int depth) {
    if (depth > kMostNested) fail("lists less deep");
    Json found = Json::object();
    ++at_;
    next_line();
    for (bool goes_on = letter(at_) != '}'; goes_on; goes_on = take_comma('}')) {
      if (done()) break;
      const bool is_quoted = is_one_of(letter(at_), "\"'");
      const std::string key = is_quoted ? quoted() : flow_key();
      skip_blanks();
      if (letter(at_) != ':' || !(is_quoted || is_end(at_ + 1))) fail("key: value in a map");
      add_key(found, key);
      ++at_;
      next_line();
      found[key] = flow_value(depth + 1);
      next_line();
    }
    take_bracket('}', "key: value and , in a map");
    return found;
  }

  std::string flow_key() {
    if (is_one_of(letter(at_), "[{:,]")) fail("key: value in a map");
    refuse_by_name(letter(at_));
    return std::string(word(",[]{}"));
  }

  Json flow_value(int depth) {
    const char first = letter(at_);
    if (first == '[') return flow_list(depth);
    if (first == '{') return flow_map(depth);
    if (is_one_of(first, "\"'")) return quoted();
    if (done() || is_one_of(first, ",]}")) fail("a value behind , [ or :");
    refuse_by_name(first);
    return scalar_of(word(",[]{}"));
  }

  bool take_comma(char end) {
    if (letter(at_) != ',') return false;
    ++at_;
    next_line();
    return letter(at_) != end;
  }

  void take_bracket(char bracket, std::string_view rule) {
    if (done()) fail(bracket == ']' ? "] where the list ends" : "} where the map ends");
    if (text_[at_] != bracket) fail(rule);
    ++at_;
  }

  [[noreturn]] void fail(std::string_view rule) const {
    const std::string_view before = text_.substr(0, at_);
    throw ConfigError(fmt::format("{}:{}: expected {}", name_, 1 + std::ranges::count(before, '\n'), rule));
  }

  static constexpr const char* kValue = "a number, a word, a string in quotes, a list in [ ] or a map in { }";

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::size_t line_begin_ = 0;
  bool begun_ = false;  ///< the document
  bool ended_ = false;
};

// Keys are looked up one by one.
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

}  // namespace

Json calibration_tree(std::string_view text, const std::string& name) {
  check_text(text, name);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // byte-order mark
  const std::string_view begun = text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (begun.starts_with('<')) return Xml(begun, name).read();
  const std::size_t second = begun.find_first_not_of(" \t\r\n", 1);
  const bool is_json = begun.starts_with('{') && second != std::string_view::npos && begun[second] == '"';
  return is_json ? parse_json(text, name) : Yaml(text, name).read();
}

}  // namespace thermal
