#pragma once

#include "io/files.h"

namespace thermal {

/// An empty folder of this name, its parents made where need be. What was there is removed; a link alone, not what it
/// leads to. IoError if its parent is a link to elsewhere, and where the system refuses; TryAgainError when the disk is
/// full.
void make_fresh_folder(const Path& folder);

/// Renames a folder that is whole to `place`, in one step where there is one already, which is then removed: whoever
/// looks, or is killed, finds the old one or the new one. IoError or TryAgainError naming the place.
void replace_folder(const Path& whole, const Path& place);

/// Removes a folder and all in it, links alone; whether it could is not told.
void sweep_folder(const Path& folder) noexcept;

}  // namespace thermal
