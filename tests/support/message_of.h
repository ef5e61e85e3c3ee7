#pragma once

#include <string>

/// The message of the exception that `work` throws; a text that equals no message if it throws none of this type.
/// Other exceptions pass through, and Catch2 reports them.
template <typename Fault, typename Work>
std::string message_of(const Work& work) {
  try {
    work();
  } catch (const Fault& fault) {
    return fault.what();
  }
  return "(no fault was thrown)";
}
