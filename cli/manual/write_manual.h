#pragma once

namespace veldt {

/// Writes manual pages and completions into a folder, in the subfolders of share/ that Debian's man, bash, zsh and fish
/// use. Throws exceptions on failure.
void write_manual(const char* share);

}  // namespace veldt
