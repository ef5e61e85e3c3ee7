#include "io/html_page.h"

#include <cassert>
#include <map>

#include "io/system/sha256.h"

namespace thermal {
namespace {

/// The parts of the page, by their names in page.html between {{ and }}.
using Pieces = std::map<std::string, std::string>;

std::string as_html(const std::string& text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

/// JSON without "</", which would end the enclosing script.
std::string as_script_data(const Json& json) {
  const std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {  // "<" occurs in strings only
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

/// A script's or style's source expression in a Content-Security-Policy.
std::string source_of(const std::string& text) {
  const std::string hex = sha256_of(text);
  std::string digest;
  for (std::size_t k = 0; k < hex.size(); k += 2)
    digest += static_cast<char>(std::stoi(hex.substr(k, 2), nullptr, 16));
  return "'sha256-" + base64_of(digest) + "'";
}

std::string filled(const std::string& page, const Pieces& pieces) {
  std::string out;
  std::size_t at = 0;
  for (std::size_t open = page.find("{{"); open != std::string::npos; open = page.find("{{", at)) {
    const std::size_t close = page.find("}}", open);
    assert(close != std::string::npos);
    out += page.substr(at, open - at) + pieces.at(page.substr(open + 2, close - open - 2));
    at = close + 2;
  }
  return out + page.substr(at);
}

}  // namespace

std::string html_page(const Json& figures, const HtmlPage& page, const Assets& assets) {
  const Path folder = assets.folder("report");
  Pieces pieces = {{"title", as_html(page.title)},
                   {"kind", as_html(page.kind)},
                   {"style", read_file(folder / "style.css")},
                   {"library", read_file(folder / "chart.umd.min.js")},
                   {"licence", as_html(read_file(folder / "LICENSE"))},
                   {"figures", as_script_data(figures)}};
  for (const std::string& script : page.scripts) pieces["script"] += read_file(folder / script);
  pieces["policy"] = "default-src 'none'; img-src data:; style-src " + source_of(pieces["style"]) +
                     "; script-src " + source_of(pieces["library"]) + " " + source_of(pieces["script"]) +
                     "; base-uri 'none'; form-action 'none'";
  return filled(read_file(folder / "page.html"), pieces);
}

}  // namespace thermal
