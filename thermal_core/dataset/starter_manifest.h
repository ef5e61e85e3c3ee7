#pragma once

#include <string>
#include <vector>

#include "dataset/inspection.h"
#include "dataset/known_things.h"

namespace thermal {

/// A manifest to fill in, for passes that have none.
struct StarterManifest {
  Json document;
  std::vector<std::string>
      guesses;  ///< entries that were guessed, and from what: "camera.fx_px = 444.444 (a lens of …)"
  std::vector<std::string> to_fill_in;  ///< entries that say kFillIn
};

/// Writes down what an inspection of all frames found, and guesses what it can: an object's material, class and category
/// by words in its name, the ground by its being most, the camera's lens and frame rate as Blender has them. What cannot
/// be guessed says kFillIn, and converting names it.
/// DataError if the passes cannot be converted, or there is nothing but sky in them.
[[nodiscard]] StarterManifest starter_manifest(const Inspection& inspection, const KnownThings& known);

}  // namespace thermal
