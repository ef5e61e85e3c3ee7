#include "dataset/layout.h"

#include <fmt/format.h>

namespace thermal {

std::string frame_name(int frame) { return fmt::format("{:06}.png", frame); }

std::string passes_name(int frame) { return fmt::format("{:06}.exr", frame); }

std::string ir16_file(const std::string& ir8_file) {
  const Path path(ir8_file);
  return (path.parent_path().parent_path() / "ir16" / path.filename()).string();
}

}  // namespace thermal
