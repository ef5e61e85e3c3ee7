#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace thermal {

/// Base of all errors caused by the user, the data or the machine; what() is a message the user can act on.
/// Programmer errors are assertions instead.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An invalid config, flag or request.
class ConfigError : public Error {
 public:
  using Error::Error;
};

/// A file was read, but its contents are invalid.
class DataError : public Error {
 public:
  using Error::Error;
};

/// A file, folder or program could not be read, written or run.
class IoError : public Error {
 public:
  using Error::Error;
};

/// A temporary error: a full disk, another run in the same folder.
class TryAgainError : public Error {
 public:
  using Error::Error;
};

/// The user requested a stop.
class Cancelled : public Error {
 public:
  Cancelled();
};

/// "<where> = <value> <unit>; expected <rule>"; an empty unit is left out.
[[nodiscard]] std::string fault(std::string_view where, std::string_view value, std::string_view unit,
                                std::string_view rule);

/// A line "<name>: <fault>" for each fault.
[[nodiscard]] std::string fault_lines(const std::vector<std::string>& faults, const std::string& name);

/// An error with these lines; does nothing if there are no faults.
template <typename Fault = ConfigError>
void throw_faults(const std::vector<std::string>& faults, const std::string& name) {
  if (!faults.empty()) throw Fault(fault_lines(faults, name));
}

/// ConfigError with `where` unless `low` <= value <= `high`; NaN is outside.
void require_range(std::string_view where, double value, std::string_view unit, double low, double high);

/// ConfigError with `where` unless the value is above 0 and at most 1, as an emissivity is.
void require_share_above_0(std::string_view where, double value);

}  // namespace thermal
