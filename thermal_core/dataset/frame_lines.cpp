#include "dataset/frame_lines.h"

#include <sstream>
#include <string>

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {

void for_frame_lines(const Path& file, const std::function<void(const Json& frame)>& take) {
  std::istringstream lines(read_file(file));
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    try {
      take(Json::parse(line));
    } catch (const Json::exception& error) {
      throw DataError(fmt::format("{}:{}: not a frame of a clip: {}", file.string(), number, error.what()));
    }
  }
}

}  // namespace thermal
