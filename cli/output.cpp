#include "cli/output.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sstream>
#include <tuple>
#include <vector>

#include <fcntl.h>

namespace veldt {
namespace {

constexpr std::size_t kMostFaultLines = 30;

/// JSON does not escape delete and the control characters U+0080 to 9F, which can occur in strings only.
std::string escaped(const std::string& json) {
  std::string out;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const auto byte = static_cast<unsigned char>(json[i]);
    const auto next = i + 1 < json.size() ? static_cast<unsigned char>(json[i + 1]) : 0U;
    if (byte == 0x7f) {
      out += "\\u007f";
    } else if (byte == 0xc2 && next >= 0x80 && next < 0xa0) {
      out += fmt::format("\\u{:04x}", next);
      ++i;
    } else {
      out += json[i];
    }
  }
  return out;
}

}  // namespace

void print_json(const thermal::Json& document) { fmt::print(stdout, "{}\n", escaped(document.dump(2))); }

void print_event(const thermal::Json& document) { fmt::print(stderr, "{}\n", escaped(document.dump())); }

void print_fault(const std::string& what) {
  std::istringstream text(what);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  const std::size_t printed = std::min(lines.size(), kMostFaultLines);
  for (std::size_t i = 0; i < printed; ++i) print_error("veldt: {}\n", lines[i]);
  if (lines.size() > printed) print_error("veldt: … and {} more\n", lines.size() - printed);
}

void open_standard_streams() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor) {
    // open() returns the lowest free descriptor, which is this one.
    if (::fcntl(descriptor, F_GETFD) == -1) std::ignore = ::open("/dev/null", O_RDWR);
  }
}

int written(int code) {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  print_error("veldt: cannot write standard output{}\n",
              errno == 0 ? "" : std::string(": ") + std::strerror(errno));
  return kFailed;
}

}  // namespace veldt
