#pragma once

#include <concepts>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/printable.h"
#include "io/json/file.h"

/// All that the command prints goes through these functions, because names in files may hold what terminals obey.
namespace veldt {

/// A text as terminals may have it; anything else as it is.
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

/// fmt::print to standard output, with texts among the values made printable: a text is one line at most.
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

/// Prints every line of a fault on standard error; of many, the first and how many more there are.
void print_fault(const std::string& what);

/// Opens those of descriptors 0 to 2 that are closed, on /dev/null: what is printed would land in the next file that
/// is opened.
void open_standard_streams();

/// Writes what is buffered for standard output. Returns `code`; or kFailed, after saying so, if not all that was printed
/// could be written.
[[nodiscard]] int written(int code);

}  // namespace veldt
