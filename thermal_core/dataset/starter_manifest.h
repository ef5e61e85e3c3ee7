#pragma once

#include <string>
#include <vector>

#include "dataset/inspection.h"
#include "dataset/name_guesser.h"

namespace thermal {

/// A manifest to complete, for passes that have none.
struct StarterManifest {
  Json document;
  std::vector<std::string>
      guesses;  ///< guessed entries, with the reason: "camera.fx_px = 444.444 (a lens of …)"
  std::vector<std::string> to_fill_in;  ///< entries that are kFillIn
};

/// Writes what an inspection of all frames found, and guesses what it can: an object's material, class and category
/// by words in its name, the ground by its area, the camera's lens and frame rate by Blender's defaults. Everything
/// else is kFillIn, which a conversion reports.
/// DataError if the passes cannot be converted, or show only sky.
[[nodiscard]] StarterManifest starter_manifest(const Inspection& inspection, const NameGuesser& known);

}  // namespace thermal
