#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/assets.h"
#include "io/system/files.h"
#include "scene/manifest.h"

namespace thermal {

/// Likely meaning of an object, in terms of a manifest.
struct KnownThing {
  ObjectClass object_class = ObjectClass::ground;
  std::string material;
  std::string category;  ///< actors
  std::string species;   ///< actors

  [[nodiscard]] bool operator==(const KnownThing&) const = default;
};

/// The words of a name, in lower case: "Elephant_bull.001" and "elephantBull" have elephant and bull.
[[nodiscard]] std::vector<std::string> words_of(std::string_view name);

/// Guesses the meaning of objects from their names.
class NameGuesser {
 public:
  /// Knows the assets' species and plants, kinds of ground, and common words for them.
  explicit NameGuesser(const Assets& assets);

  /// Searches by one or two words of the name, also plurals: the first known word, pairs before single words. Empty if
  /// none is known.
  [[nodiscard]] std::optional<KnownThing> find(std::string_view name) const;

 private:
  [[nodiscard]] const KnownThing* find_word(const std::string& word) const;

  std::map<std::string, KnownThing> things_;  ///< by word, or two joined by _
};

}  // namespace thermal
