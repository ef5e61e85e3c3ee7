#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dataset/inspect/inspection.h"
#include "dataset/inspect/name_guesser.h"

namespace thermal {

/// An object of a starter manifest.
struct StarterObject {
  int index = 0;
  std::string name;
  std::int64_t pixels = 0;
  std::optional<Colour> colour = {};
  std::vector<std::string> mattes = {};  ///< empty: its name
  std::optional<KnownThing> known = {};  ///< likely meaning
  std::string reason = {};               ///< basis of the guess
};

/// The objects of an inspection: indices unchanged, names of a cryptomatte and colours numbered from 1, most pixels
/// first. Mattes of one kind of ground or plant are one object, as are more than twenty copies of one name.
[[nodiscard]] std::vector<StarterObject> starter_objects(const Inspection& inspection,
                                                         const NameGuesser& known);

/// A manifest to complete, for passes that have none.
struct StarterManifest {
  Json document;
  std::vector<std::string>
      guesses;  ///< guessed entries, with the reason: "camera.fx_px = 444.444 (a lens of …)"
  std::vector<std::string> to_fill_in;  ///< entries that are kFillIn
};

/// A manifest from an inspection of all frames. Guesses an object's material, class and category from its name, the
/// ground from its area, the camera's lens and frame rate from Blender's defaults. Everything else is kFillIn, which a
/// conversion reports.
/// DataError if the passes cannot be converted, or show only sky.
[[nodiscard]] StarterManifest starter_manifest(const Inspection& inspection, const NameGuesser& known);

}  // namespace thermal
