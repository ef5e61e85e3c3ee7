#include "dataset/inspect/name_guesser.h"

#include <array>
#include <utility>

#include "io/assets.h"
#include "io/json/file.h"

namespace thermal {
namespace {

/// Materials that are ground; ground has no asset files.
constexpr std::array<const char*, 4> kGrounds = {"soil", "wet_soil", "grass", "road"};

/// Common names for objects in the assets; estimates, reported to the user as guesses.
constexpr std::array<std::pair<const char*, const char*>, 24> kOtherWords = {{
    {"person", "human"},     {"people", "human"}, {"man", "human"},        {"woman", "human"},
    {"poacher", "human"},    {"ranger", "human"}, {"pedestrian", "human"}, {"hippo", "hippopotamus"},
    {"rhino", "rhinoceros"}, {"car", "pickup"},   {"jeep", "pickup"},      {"truck", "lorry"},
    {"ground", "soil"},      {"terrain", "soil"}, {"floor", "soil"},       {"plane", "soil"},
    {"dirt", "soil"},        {"sand", "soil"},    {"mud", "wet_soil"},     {"tree", "acacia"},
    {"bush", "shrub"},       {"stone", "rock"},   {"lake", "water"},       {"river", "water"},
}};

bool is_letter(char letter) noexcept {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z');
}
bool is_capital(char letter) noexcept { return letter >= 'A' && letter <= 'Z'; }

template <typename Take>
void for_each_json(const Path& folder, const Take& take) {
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json") take(entry.path().stem().string(), read_json(entry.path()));
}

/// Main material of a plant or structure: its own, or the first of those seen from above.
std::string main_material(const Json& standing) {
  if (standing.contains("material")) return standing["material"];
  const Json& slot = *standing.at("materials").begin();
  return slot.is_array() ? slot.at(0) : slot;
}

}  // namespace

std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  char before = ' ';
  for (const char letter : name) {
    const bool begins = !is_letter(before) || (is_capital(letter) && !is_capital(before));
    if (is_letter(letter)) {
      if (begins) words.emplace_back();
      words.back() += is_capital(letter) ? static_cast<char>(letter - 'A' + 'a') : letter;
    }
    before = letter;
  }
  return words;
}

NameGuesser::NameGuesser(const Assets& assets) {
  for_each_json(assets.folder("species"), [this](const std::string& name, const Json& species) {
    things_[name] = {.object_class = ObjectClass::actor,
                     .material = species.at("material"),
                     .category = species.at("category"),
                     .species = name};
  });
  for (const char* kind : {"structures", "plants"}) {
    for_each_json(assets.folder(kind), [this](const std::string& name, const Json& standing) {
      things_[name] = {.object_class = ObjectClass::plant,
                       .material = main_material(standing),
                       .category = "",
                       .species = ""};
    });
  }
  for (const char* ground : kGrounds)
    things_[ground] = {
        .object_class = ObjectClass::ground, .material = ground, .category = "", .species = ""};
  things_["water"] = {.object_class = ObjectClass::water, .material = "water", .category = "", .species = ""};
  for (const auto& [word, thing] : kOtherWords)
    if (const auto known = things_.find(thing); known != things_.end()) things_[word] = known->second;
}

const KnownThing* NameGuesser::find_word(const std::string& word) const {
  auto known = things_.find(word);
  if (known == things_.end() && word.ends_with('s')) known = things_.find(word.substr(0, word.size() - 1));
  return known == things_.end() ? nullptr : &known->second;
}

std::optional<KnownThing> NameGuesser::find(std::string_view name) const {
  const std::vector<std::string> words = words_of(name);
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    if (const KnownThing* known = find_word(words[i] + "_" + words[i + 1])) return *known;
  for (const std::string& word : words)
    if (const KnownThing* known = find_word(word)) return *known;
  return std::nullopt;
}

}  // namespace thermal
