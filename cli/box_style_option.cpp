#include "cli/box_style_option.h"

namespace veldt {

void add_box_style(CLI::App& command, thermal::BoxStyle& style, const std::string& help) {
  command
      .add_option_function<std::string>(
          "--box-style",
          [&style](const std::string& name) {
            style = name == "drawn" ? thermal::BoxStyle::drawn : thermal::BoxStyle::visible;
          },
          help)
      ->check(CLI::IsMember({"visible", "drawn"}))
      ->default_str("visible");
}

}  // namespace veldt
