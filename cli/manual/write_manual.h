#pragma once

namespace veldt {

/// Writes manual pages and completions into a folder, where Debian's man, bash, zsh and fish look for them below share/.
/// Exceptions say what failed.
void write_manual(const char* share);

}  // namespace veldt
