#pragma once

#include <string>

#include "cli/manual/command_texts.h"

namespace veldt {

// Completion scripts: commands, options, the values of options with a fixed choice, and files elsewhere. None runs the
// program.

[[nodiscard]] std::string bash_completion(const ProgramText& text);
[[nodiscard]] std::string zsh_completion(const ProgramText& text);
[[nodiscard]] std::string fish_completion(const ProgramText& text);

}  // namespace veldt
