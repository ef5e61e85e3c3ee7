#pragma once

#include "io/files.h"

namespace thermal {

/// Creates an empty folder of this name, and its parents. Existing contents are removed; of a link, only the link
/// itself. IoError if its parent is a link to elsewhere, or with the system's reason; TryAgainError if the disk is
/// full.
void make_fresh_folder(const Path& folder);

/// Creates a folder, unless it exists, in which other programs will write files by their names. IoError if it, or
/// anything in it at any depth, is a link to elsewhere, or with the system's reason; TryAgainError if the disk is full.
void make_own_folder(const Path& folder);

/// Renames a complete folder to `place`, replacing an existing one in one step: a reader, or a run killed in between,
/// finds either the old one or the new one. IoError or TryAgainError with the place.
void replace_folder(const Path& whole, const Path& place);

/// Removes a folder with its contents; of links, only the links. Failure is not reported.
void sweep_folder(const Path& folder) noexcept;

}  // namespace thermal
