#pragma once

#include "io/assets.h"
#include "io/json/file.h"

namespace thermal {

/// The HTML page that shows `figures`: assets/report/page.html with style, scripts and figures inserted, so that it
/// is self-contained. Its Content-Security-Policy blocks everything else. All strings in figures are shown as text.
/// `title` is the page's.
[[nodiscard]] std::string report_page(const Json& figures, const std::string& title, const Assets& assets);

}  // namespace thermal
