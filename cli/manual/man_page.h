#pragma once

#include <string>

#include "cli/manual/command_texts.h"

namespace veldt {

/// A page of section 1 in roff, with macros of man(7) that groff and mandoc know: about a command, or about the program
/// itself. `version` goes into its footer; it has no date, so that the same program has the same pages.
/// @param command  text.program or one of text.commands
[[nodiscard]] std::string man_page(const ProgramText& text, const CommandText& command,
                                   const std::string& version);

/// What a command's page is called, without ".1": "veldt-generate"; the program's is "veldt".
[[nodiscard]] std::string page_name(const ProgramText& text, const CommandText& command);

}  // namespace veldt
