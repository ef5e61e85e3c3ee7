#include "cli/named_document.h"

#include <system_error>

#include <unistd.h>

#include "base/error.h"

namespace veldt {
namespace {

bool can_be_read(const thermal::Path& file) {
  std::error_code none;
  return std::filesystem::is_regular_file(file, none) && ::access(file.c_str(), R_OK) == 0;
}

}  // namespace

thermal::Json read_named_document(const thermal::Path& file) {
  try {
    return thermal::read_json(file);
  } catch (const thermal::IoError& error) {
    if (can_be_read(file)) throw;
    throw thermal::ConfigError(error.what());
  }
}

}  // namespace veldt
