#pragma once

#include <string>

#include "cli/manual/command_texts.h"

namespace veldt {

/// A page of section 1 in roff, with macros of man(7) for groff and mandoc, for a command or the program. `version` is
/// in its footer; it has no date, so that pages are reproducible.
/// @param command  text.program or one of text.commands
[[nodiscard]] std::string man_page(const ProgramText& text, const CommandText& command,
                                   const std::string& version);

/// File name of a command's page, without ".1": "veldt-generate"; the program's is "veldt".
[[nodiscard]] std::string page_name(const ProgramText& text, const CommandText& command);

}  // namespace veldt
