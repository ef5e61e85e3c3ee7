#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace thermal {

/// Any fault that is the user's, the data's or the machine's, told in words a person can act on.
/// Programmer faults are assertions instead.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A config, flag or request that cannot be meant.
class ConfigError : public Error {
 public:
  using Error::Error;
};

/// A file that was read but holds what it must not.
class DataError : public Error {
 public:
  using Error::Error;
};

/// A file, folder or program that could not be read, written or run.
class IoError : public Error {
 public:
  using Error::Error;
};

/// A fault that passes by itself: a full disk, another run in the same folder.
class TryAgainError : public Error {
 public:
  using Error::Error;
};

/// The person asked to stop.
class Cancelled : public Error {
 public:
  Cancelled();
};

/// "<where> = <value> <unit>; expected <rule>"; the unit is left out where it is empty.
[[nodiscard]] std::string fault(std::string_view where, std::string_view value, std::string_view unit,
                                std::string_view rule);

}  // namespace thermal
