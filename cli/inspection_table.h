#pragma once

#include "dataset/inspect/inspection.h"
#include "dataset/inspect/starter_manifest.h"

namespace veldt {

/// Prints what passes hold, and what a conversion would do with them.
void print_inspection(const thermal::Inspection& inspection);

/// Prints what a starter manifest guessed, what the user has to fill in, and the command to run next.
void print_starter(const thermal::StarterManifest& starter, const thermal::Inspection& inspection,
                   const thermal::Path& file);

}  // namespace veldt
