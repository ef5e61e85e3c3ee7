#pragma once

#include <string>
#include <string_view>

namespace thermal {

/// Bytes as text: RFC 4648, section 4, padded.
[[nodiscard]] std::string base64_of(std::string_view bytes);

}  // namespace thermal
