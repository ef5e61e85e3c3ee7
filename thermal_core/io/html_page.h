#pragma once

#include <string>
#include <vector>

#include "io/assets.h"
#include "io/json/file.h"

namespace thermal {

/// Parts of one kind of page.
struct HtmlPage {
  std::string title;
  std::string kind;                  ///< follows the title, such as "Veldt report"
  std::vector<std::string> scripts;  ///< in assets/report, in this order; the last draws the page
};

/// The HTML page that shows `figures`: assets/report/page.html with style, scripts and figures inserted, so that it
/// is self-contained. Its Content-Security-Policy blocks everything else. All strings in figures are shown as text.
[[nodiscard]] std::string html_page(const Json& figures, const HtmlPage& page, const Assets& assets);

}  // namespace thermal
