#pragma once

#include "io/files.h"

namespace thermal {

/// How to give a file a second location.
enum class Linking { hard, symlink, copy };

/// Makes `as` the same file as `file`, creating missing folders: a hard link, a symbolic link to its absolute path,
/// or a copy. If `file` is a symbolic link, its target is linked. Falls back to a copy where the file system cannot
/// link: across file systems, past its limit of links. Returns what was done. Never replaces or writes through what is at
/// `as`. IoError with the file and the system's reason; TryAgainError if the disk is full.
Linking link_file(const Path& file, const Path& as, Linking wanted);

}  // namespace thermal
