#pragma once

#include "io/json_file.h"

namespace thermal {

/// The HTML page that shows `figures`: assets/report/page.html with style, scripts and figures put in, so that it needs
/// nothing but itself. Its Content-Security-Policy lets run and load nothing else. Whatever strings figures hold,
/// they are shown as text. `title` is the page's.
[[nodiscard]] std::string report_page(const Json& figures, const std::string& title, const Path& home);

}  // namespace thermal
