#pragma once

#include <string>
#include <string_view>

namespace thermal {

/// Encodes bytes as base64: RFC 4648, section 4, padded.
[[nodiscard]] std::string base64_of(std::string_view bytes);

}  // namespace thermal
