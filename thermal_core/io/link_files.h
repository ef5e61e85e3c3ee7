#pragma once

#include "io/files.h"

namespace thermal {

/// How a file gets a second place.
enum class Linking { hard, symlink, copy };

/// Lets `as` be the file that `file` is, in folders that are made where they are missing: a second name of it, a
/// symbolic link to its absolute path, or a copy. What is linked is the file itself where `file` is a symbolic link.
/// Falls back to a copy where the file system cannot link: across its border, past its most links. Returns what was
/// done. IoError naming the file and the system's reason; TryAgainError when the disk is full.
Linking link_file(const Path& file, const Path& as, Linking wanted);

}  // namespace thermal
