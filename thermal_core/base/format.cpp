#include <string>

#include <fmt/format.h>

namespace thermal {
namespace {

/// Other sources of the core include <fmt/core.h> alone, which declares this function and takes a third of the time to
/// compile. Its body is here, with all that it calls.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): it points to a function
[[gnu::used]] std::string (*const kFormat)(fmt::string_view, fmt::format_args) = fmt::vformat;

}  // namespace
}  // namespace thermal
