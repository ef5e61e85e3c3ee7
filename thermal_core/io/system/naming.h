#pragma once

#include "base/error.h"
#include "io/system/files.h"

namespace thermal {

/// The result of `work`; messages of DataErrors are prefixed with the file's name.
template <typename Work>
auto naming(const Path& file, const Work& work) {
  try {
    return work();
  } catch (const DataError& error) {
    throw DataError(file.string() + ": " + error.what());
  }
}

}  // namespace thermal
