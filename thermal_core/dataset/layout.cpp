#include "dataset/layout.h"

#include <fmt/format.h>

namespace thermal {

std::string frame_name(int frame) { return fmt::format("{:06}.png", frame); }

std::string passes_name(int frame) { return fmt::format("{:06}.exr", frame); }

}  // namespace thermal
