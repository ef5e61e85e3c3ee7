#pragma once

#include <concepts>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "io/json/file.h"

/// All output goes through these functions, because names in files may contain escape sequences for terminals.
namespace veldt {

/// Makes a text printable; other values are unchanged.
template <typename Value>
decltype(auto) shown(const Value& value) {
  if constexpr (std::convertible_to<const Value&, std::string_view>) {
    return thermal::printable(value);
  } else {
    return (value);
  }
}

template <typename... Values>
using ShownFormat = fmt::format_string<decltype(shown(std::declval<const Values&>()))...>;

/// fmt::print to standard output, with texts among the values made printable, each on one line.
template <typename... Values>
void print(ShownFormat<Values...> format, const Values&... values) {
  fmt::print(stdout, format, shown(values)...);
}

/// The same to standard error.
template <typename... Values>
void print_error(ShownFormat<Values...> format, const Values&... values) {
  fmt::print(stderr, format, shown(values)...);
}

/// Exit codes; scripts rely on the numbers.
enum ExitCode : int {
  kDone = 0,
  kFailed = 1,
  kBadUsage = 2,
  kSomeRejected = 3,
  kTryAgain = 75,
};

/// A document on standard output, indented.
void print_json(const thermal::Json& document);

/// A document on standard error, as one line.
void print_event(const thermal::Json& document);

/// Prints every line of a fault on standard error; of many, the first ones and the number of the others.
void print_fault(const std::string& what);

/// Opens closed ones of descriptors 0 to 2 on /dev/null: otherwise output would go to the next file that is opened.
void open_standard_streams();

/// Flushes standard output. Returns `code`; or kFailed, with a message, if some output could not be written.
[[nodiscard]] int written(int code);

}  // namespace veldt
