#include "io/name_pattern.h"

#include <algorithm>

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

/// How many letters of name[i, …) piece k takes so that the rest matches: numbers are greedy, stars are not.
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
      // Whether a star's rest matches one letter on is known already, so patterns with many stars are no slower.
      const bool star = pieces_[k].kind == Kind::any_letters;
      fits[k][i] = star ? fits[k + 1][i] || (i < name.size() && fits[k][i + 1])
                        : length_at(fits, name, k, i).has_value();
    }
  }
  return fits;
}

std::optional<NumberPlace> NamePattern::match(std::string_view name) const {
  const Fits fits = fits_of(name);
  if (!fits[0][0]) return std::nullopt;
  NumberPlace place;
  for (std::size_t k = 0, i = 0; k < pieces_.size(); ++k) {
    const std::size_t length = length_at(fits, name, k, i).value_or(0);
    if (pieces_[k].kind == Kind::number) place = {.at = i, .digits = length};
    i += length;
  }
  return place;
}

}  // namespace thermal
