#pragma once

#include "dataset/inspect/inspection.h"
#include "dataset/inspect/starter_manifest.h"

namespace veldt {

/// Prints the contents of passes, and how a conversion would use them.
void print_inspection(const thermal::Inspection& inspection);

/// Prints a starter manifest's guesses, the entries that the user has to fill in, and the next command.
void print_starter(const thermal::StarterManifest& starter, const thermal::Inspection& inspection,
                   const thermal::Path& file);

}  // namespace veldt
