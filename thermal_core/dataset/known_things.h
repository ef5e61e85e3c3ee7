#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/files.h"
#include "scene/manifest.h"

namespace thermal {

/// What an object most likely is, in a manifest's words.
struct KnownThing {
  ObjectClass object_class = ObjectClass::ground;
  std::string material;
  std::string category;  ///< actors
  std::string species;   ///< actors

  [[nodiscard]] bool operator==(const KnownThing&) const = default;
};

/// The words of a name, in small letters: "Elephant_bull.001" and "elephantBull" have elephant and bull.
[[nodiscard]] std::vector<std::string> words_of(std::string_view name);

/// Tells what things are from the names that people give them.
class KnownThings {
 public:
  /// Knows the species and plants of `home`/assets, kinds of ground, and common words for them.
  explicit KnownThings(const Path& home);

  /// By one word of the name, or two: the first that is known, two before one; in the plural, too. Nothing if none is.
  [[nodiscard]] std::optional<KnownThing> find(std::string_view name) const;

 private:
  [[nodiscard]] const KnownThing* find_word(const std::string& word) const;

  std::map<std::string, KnownThing> things_;  ///< by word, or two with _ between
};

}  // namespace thermal
