#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dataset/inspection.h"
#include "dataset/name_guesser.h"

namespace thermal {

/// An object of a starter manifest.
struct StarterObject {
  int index = 0;
  std::string name;
  std::int64_t pixels = 0;
  std::optional<Colour> colour = {};
  std::vector<std::string> mattes = {};  ///< empty: its name
  std::optional<KnownThing> known = {};  ///< what it most likely is
  std::string reason = {};               ///< what the guess is based on
};

/// The objects that an inspection found: indices unchanged, names of a cryptomatte and colours numbered from 1, most
/// pixels first. Mattes of one kind of ground or plant are one object, and so are more than twenty copies of
/// anything.
[[nodiscard]] std::vector<StarterObject> starter_objects(const Inspection& inspection,
                                                         const NameGuesser& known);

}  // namespace thermal
