#include "io/system/sequence.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

constexpr std::size_t kLongestName = 255;

bool is_digit(char letter) noexcept { return letter >= '0' && letter <= '9'; }

std::size_t digits_before(std::string_view text) noexcept {
  const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
  return static_cast<std::size_t>(end - text.begin());
}

}  // namespace

/// Parses a pattern.
struct NamePattern::Reader {
  std::string_view text;
  std::string_view where;
  std::vector<Piece> pieces = {};

  [[noreturn]] void fail(std::string_view rule) const {
    throw ConfigError(fault(where, fmt::format("\"{}\"", text), "", rule));
  }

  void read() {
    if (text.size() > kLongestName) fail(fmt::format("at most {} characters", kLongestName));
    if (text.find('/') != std::string_view::npos) fail("names in one folder, without /");
    for (std::size_t at = 0; at < text.size();) at += read_piece(text.substr(at));
    const auto is_number = [](const Piece& piece) { return piece.kind == Kind::number; };
    if (std::count_if(pieces.begin(), pieces.end(), is_number) > 1) fail("one number, such as #### or %06d");
  }

  std::size_t read_piece(std::string_view rest) {
    if (rest.front() == '%') return read_printf(rest);
    if (rest.front() == '#') return read_hashes(rest);
    Piece piece{.kind = Kind::letter, .letter = rest.front(), .digits = 0};
    if (piece.letter == '*') piece.kind = Kind::any_letters;
    if (piece.letter == '?') piece.kind = Kind::any_letter;
    pieces.push_back(piece);
    return 1;
  }

  std::size_t read_hashes(std::string_view rest) {
    const std::size_t length = std::min(rest.find_first_not_of('#'), rest.size());
    add_number(length);
    return length;
  }

  /// %d or %0Nd.
  std::size_t read_printf(std::string_view rest) {
    const std::size_t length = digits_before(rest.substr(1));
    const std::string_view digits = rest.substr(1, length);
    const bool padded = length >= 2 && digits.front() == '0';
    if ((length > 0 && !padded) || rest.substr(1 + length, 1) != "d") fail("% only as in %d or %06d");
    add_number(padded ? number_in<std::size_t>(digits).value_or(0) : 1);
    return length + 2;
  }

  void add_number(std::size_t digits) {
    if (digits < 1 || digits > kMostDigits) fail(fmt::format("numbers of 1 to {} digits", kMostDigits));
    pieces.push_back({.kind = Kind::number, .letter = 0, .digits = digits});
  }
};

NamePattern::NamePattern(std::string_view text, std::string_view where) {
  Reader reader{.text = text, .where = where};
  reader.read();
  pieces_ = std::move(reader.pieces);
}

bool NamePattern::has_wildcards(std::string_view name) noexcept {
  return name.find_first_of("*?#%") != std::string_view::npos;
}

NamePattern::Range NamePattern::takes(const Piece& piece, std::string_view rest) noexcept {
  if (piece.kind == Kind::any_letters) return {.least = 0, .most = rest.size(), .none = false};
  if (piece.kind == Kind::number) {
    const std::size_t most =
        rest.substr(0, 1) == "0" ? std::min(piece.digits, digits_before(rest)) : digits_before(rest);
    return {.least = piece.digits, .most = most, .none = most < piece.digits};
  }
  const bool takes_one = !rest.empty() && (piece.kind == Kind::any_letter || rest.front() == piece.letter);
  return {.least = 1, .most = 1, .none = !takes_one};
}

/// Number of letters of name[i, …) that piece k takes so that the rest matches: numbers are greedy, stars are not.
std::optional<std::size_t> NamePattern::length_at(const Fits& fits, std::string_view name, std::size_t k,
                                                  std::size_t i) const {
  const Range range = takes(pieces_[k], name.substr(i));
  if (range.none) return std::nullopt;
  for (std::size_t n = 0; n <= range.most - range.least; ++n) {
    const std::size_t length = pieces_[k].kind == Kind::number ? range.most - n : range.least + n;
    if (fits[k + 1][i + length]) return length;
  }
  return std::nullopt;
}

NamePattern::Fits NamePattern::fits_of(std::string_view name) const {
  Fits fits(pieces_.size() + 1, std::vector<bool>(name.size() + 1));
  fits.back().back() = true;
  for (std::size_t k = pieces_.size(); k-- > 0;) {
    for (std::size_t i = name.size() + 1; i-- > 0;) {
      // Whether the rest of a star matches one letter later is known already, so many stars cost no additional time.
      const bool star = pieces_[k].kind == Kind::any_letters;
      fits[k][i] = star ? fits[k + 1][i] || (i < name.size() && fits[k][i + 1])
                        : length_at(fits, name, k, i).has_value();
    }
  }
  return fits;
}

std::optional<NumberPosition> NamePattern::match(std::string_view name) const {
  const Fits fits = fits_of(name);
  if (!fits[0][0]) return std::nullopt;
  NumberPosition position;
  for (std::size_t k = 0, i = 0; k < pieces_.size(); ++k) {
    const std::size_t length = length_at(fits, name, k, i).value_or(0);
    if (pieces_[k].kind == Kind::number) position = {.at = i, .digits = length};
    i += length;
  }
  return position;
}

namespace {

constexpr std::int64_t kMostGapsAFile = 10;  // more is probably a mistake, such as two time stamps

struct Numbered {
  FrameName frame;
  std::int64_t number = 0;
};

/// Runs of digits in a name, without its extension.
std::vector<NumberPosition> runs_of_digits(const std::string& name) {
  const std::string_view stem = std::string_view(name).substr(0, name.rfind('.'));
  std::vector<NumberPosition> runs;
  for (std::size_t at = stem.find_first_of("0123456789"); at < stem.size();) {
    const std::size_t end = std::min(stem.find_first_not_of("0123456789", at), stem.size());
    runs.push_back({.at = at, .digits = end - at});
    at = stem.find_first_of("0123456789", end);
  }
  return runs;
}

std::string_view digits_of(const FrameName& frame) {
  return std::string_view(frame.name).substr(frame.number.at, frame.number.digits);
}

std::int64_t number_of(const FrameName& frame, const std::string& where) {
  if (frame.number.digits > kMostDigits) {
    throw DataError(fmt::format("{}: the number of {} has {} digits; expected at most {}", where, frame.name,
                                frame.number.digits, kMostDigits));
  }
  return number_in<std::int64_t>(digits_of(frame)).value_or(0);
}

/// Takes the run of digits at this position from each name's end as its number; returns whether the numbers differ.
bool take_run(std::vector<FrameName>& frames, const std::vector<std::vector<NumberPosition>>& runs,
              std::size_t from_end) {
  bool differ = false;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const bool has_it = runs[i].size() >= from_end;
    frames[i].number = has_it ? runs[i][runs[i].size() - from_end] : NumberPosition{};
    differ = differ || digits_of(frames[i]) != digits_of(frames.front());
  }
  return differ;
}

void find_numbers(std::vector<FrameName>& frames) {
  std::vector<std::vector<NumberPosition>> runs;
  std::size_t in_all = std::string::npos;
  for (const FrameName& frame : frames) {
    runs.push_back(runs_of_digits(frame.name));
    in_all = std::min(in_all, runs.back().size());
  }
  for (std::size_t from_end = 1; from_end <= in_all; ++from_end)
    if (take_run(frames, runs, from_end)) return;
  take_run(frames, runs, 1);
}

/// Whether the frames have numbers; an error if only some have.
bool check_numbered(const std::vector<FrameName>& frames, const std::string& where) {
  const auto has_number = [](const FrameName& frame) { return frame.number.digits > 0; };
  const auto with = std::find_if(frames.begin(), frames.end(), has_number);
  const auto without = std::find_if_not(frames.begin(), frames.end(), has_number);
  if (with == frames.end()) return false;
  if (without == frames.end()) return true;
  throw DataError(
      fmt::format("{}: {} has no number, and {} has one; expected one in all names, or a pattern that "
                  "leaves some out",
                  where, without->name, with->name));
}

std::vector<Numbered> in_order(std::vector<FrameName> frames, const std::string& where) {
  std::vector<Numbered> numbered;
  for (FrameName& frame : frames) {
    const std::int64_t number = number_of(frame, where);
    numbered.push_back({.frame = std::move(frame), .number = number});
  }
  std::stable_sort(numbered.begin(), numbered.end(),
                   [](const Numbered& a, const Numbered& b) { return a.number < b.number; });
  for (std::size_t i = 1; i < numbered.size(); ++i) {
    if (numbered[i].number != numbered[i - 1].number) continue;
    throw DataError(
        fmt::format("{}: {} and {} both have number {}; expected one file per number, or a pattern that "
                    "leaves some out",
                    where, numbered[i - 1].frame.name, numbered[i].frame.name, numbered[i].number));
  }
  return numbered;
}

std::int64_t step_of(const std::vector<Numbered>& frames) {
  std::int64_t step = 0;
  for (const Numbered& frame : frames) step = std::gcd(step, frame.number - frames.front().number);
  return std::max<std::int64_t>(step, 1);
}

void check_gaps(const std::vector<Numbered>& frames, std::int64_t step, const std::string& where) {
  const auto files = static_cast<std::int64_t>(frames.size());
  const std::int64_t first = frames.front().number;
  const std::int64_t last = frames.back().number;
  const std::int64_t gaps = (last - first) / step + 1 - files;
  if (gaps <= kMostGapsAFile * files) return;
  throw DataError(fmt::format(
      "{}: {} files have numbers from {} to {} in steps of {}, so {} are missing; expected at most "
      "{} missing, or a manifest that lists the files in frames",
      where, files, first, last, step, gaps, kMostGapsAFile * files));
}

/// The name of a missing frame: another frame's with its number, in as many digits.
FrameName name_with(FrameName frame, std::int64_t number) {
  const std::string digits = fmt::format("{:0{}}", number, frame.number.digits);
  frame.name.replace(frame.number.at, frame.number.digits, digits);
  frame.number.digits = digits.size();
  return frame;
}

FrameSequence with_gaps(const std::vector<Numbered>& frames, std::int64_t step) {
  FrameSequence sequence{.frames = {}, .step = step};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    sequence.frames.push_back({.name = frames[i].frame, .is_gap = false});
    if (i + 1 == frames.size()) break;
    for (std::int64_t number = frames[i].number + step; number < frames[i + 1].number; number += step)
      sequence.frames.push_back({.name = name_with(frames[i].frame, number), .is_gap = true});
  }
  return sequence;
}

bool ends_in(const std::string& name, std::string_view ending) {
  const auto same = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; };
  return name.size() > ending.size() &&
         std::equal(ending.begin(), ending.end(), name.end() - std::ssize(ending),
                    [&same](char b, char a) { return same(a, b); });
}

std::vector<FrameName> names_ending_in(const std::vector<std::string>& names, std::string_view ending) {
  std::vector<FrameName> found;
  for (const std::string& name : names)
    if (ends_in(name, ending)) found.push_back({.name = name, .number = {}});
  return found;
}

}  // namespace

int FrameSequence::gaps() const noexcept {
  return static_cast<int>(
      std::count_if(frames.begin(), frames.end(), [](const Frame& frame) { return frame.is_gap; }));
}

FrameSequence sequence_of(std::vector<FrameName> names, const std::string& where) {
  std::sort(names.begin(), names.end(),
            [](const FrameName& a, const FrameName& b) { return a.name < b.name; });
  names.erase(std::unique(names.begin(), names.end(),
                          [](const FrameName& a, const FrameName& b) { return a.name == b.name; }),
              names.end());
  const bool known =
      std::all_of(names.begin(), names.end(), [](const FrameName& n) { return n.number.digits > 0; });
  if (!known) find_numbers(names);
  if (!check_numbered(names, where)) {
    FrameSequence sequence;
    for (FrameName& name : names) sequence.frames.push_back({.name = std::move(name), .is_gap = false});
    return sequence;
  }
  const std::vector<Numbered> numbered = in_order(std::move(names), where);
  const std::int64_t step = step_of(numbered);
  check_gaps(numbered, step, where);
  return with_gaps(numbered, step);
}

std::string pattern_of(const FrameSequence& sequence) {
  const FrameName& first = sequence.frames.front().name;
  std::string pattern = first.name;
  if (NamePattern::has_wildcards(pattern)) return "";
  std::size_t digits = kMostDigits;
  for (const auto& [name, is_gap] : sequence.frames) digits = std::min(digits, name.number.digits);
  if (digits > 0) pattern.replace(first.number.at, first.number.digits, std::string(digits, '#'));
  const NamePattern tried(pattern, "");
  const auto matches = [&tried](const FrameSequence::Frame& frame) {
    return tried.match(frame.name.name).has_value();
  };
  return std::all_of(sequence.frames.begin(), sequence.frames.end(), matches) ? pattern : "";
}

std::vector<std::string> files_in(const Path& folder) {
  std::error_code problem;
  std::vector<std::string> names;
  for (std::filesystem::directory_iterator entry(folder.empty() ? Path(".") : folder, problem), end;
       entry != end; entry.increment(problem)) {
    std::error_code gone;  // removed after the listing
    std::string name = entry->path().filename().string();
    if (entry->is_regular_file(gone) && name.front() != '.') names.push_back(std::move(name));
  }
  if (problem) throw IoError(fmt::format("cannot read {}: {}", folder.string(), problem.message()));
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<FrameName> names_matching(const NamePattern& pattern, const std::vector<std::string>& names) {
  std::vector<FrameName> found;
  for (const std::string& name : names)
    if (const auto number = pattern.match(name)) found.push_back({.name = name, .number = *number});
  return found;
}

std::vector<FrameName> passes_among(const std::vector<std::string>& names) {
  std::vector<FrameName> exr = names_ending_in(names, ".exr");
  return exr.empty() ? names_ending_in(names, ".png") : exr;
}

}  // namespace thermal
