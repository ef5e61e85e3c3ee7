#include "io/exr_spellings.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

struct Spelling {
  std::string_view name;  ///< lower case, without spaces and the like
  PassKind kind;
};

/// Preferred spellings first.
constexpr std::array<Spelling, 10> kSpellings = {{{"indexob", PassKind::object_index},
                                                  {"objectindex", PassKind::object_index},
                                                  {"objectid", PassKind::object_index},
                                                  {"indexma", PassKind::material_index},
                                                  {"materialindex", PassKind::material_index},
                                                  {"materialid", PassKind::material_index},
                                                  {"depth", PassKind::depth},
                                                  {"z", PassKind::depth},
                                                  {"normal", PassKind::normal},
                                                  {"n", PassKind::normal}}};

std::string normalised(std::string_view pass) {
  std::string text;
  for (const char c : pass) {
    if (c != ' ' && c != '_' && c != '-')
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return text;
}

const Spelling* spelling_of(std::string_view pass) {
  const std::string name = normalised(pass);
  const auto* found = std::find_if(kSpellings.begin(), kSpellings.end(),
                                   [&](const Spelling& spelling) { return spelling.name == name; });
  return found == kSpellings.end() ? nullptr : found;
}

/// How well a component fits one of a vector's, 0 best; empty if it does not.
std::optional<std::size_t> rank_of_axis(const std::string& letter, std::string_view axis) {
  if (letter == axis) return 0;
  const std::string_view colour = std::string_view("RGB").substr(std::string_view("XYZ").find(axis), 1);
  return letter == colour ? std::optional<std::size_t>(1) : std::nullopt;
}

/// How well a component fits a plane with a single one, 0 best.
std::size_t rank_of_single(const std::string& letter, PassKind kind) {
  const std::string_view order = kind == PassKind::depth ? "ZVRX" : "XVR";
  if (letter.empty()) return 0;
  if (letter == "A") return order.size() + 2;
  return 1 + std::min(order.find(letter), order.size());
}

std::optional<std::size_t> rank_of(const ExrChannel& channel, PassKind kind, std::string_view axis) {
  const std::string letter = upper_case(channel.component);
  return kind == PassKind::normal ? rank_of_axis(letter, axis) : rank_of_single(letter, kind);
}

}  // namespace

std::string upper_case(std::string_view text) {
  std::string upper(text);
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return upper;
}

std::optional<PassKind> pass_kind_of(std::string_view pass) {
  const Spelling* spelling = spelling_of(pass);
  return spelling == nullptr ? std::nullopt : std::optional(spelling->kind);
}

const ExrChannel* best_of(const std::vector<const ExrChannel*>& channels, PassKind kind,
                          std::string_view axis) {
  const ExrChannel* best = nullptr;
  std::tuple<const Spelling*, std::size_t> best_rank;
  for (const ExrChannel* channel : channels) {
    const Spelling* spelling = spelling_of(channel->pass);
    if (spelling == nullptr || spelling->kind != kind) continue;
    const std::optional<std::size_t> component = rank_of(*channel, kind, axis);
    if (!component) continue;
    const std::tuple rank(spelling, *component);
    if (best != nullptr && rank >= best_rank) continue;
    best = channel;
    best_rank = rank;
  }
  return best;
}

const ExrChannel* axis_of(const std::vector<const ExrChannel*>& channels, std::string_view axis) {
  for (const std::size_t rank : {0U, 1U}) {
    for (const ExrChannel* channel : channels) {
      if (rank_of_axis(upper_case(channel->component), axis) == rank) return channel;
    }
  }
  return nullptr;
}

const ExrChannel* only_best_of(const std::vector<const ExrChannel*>& channels, PassKind kind,
                               std::string_view axis, std::string_view choice) {
  std::map<std::string, std::vector<const ExrChannel*>> layers;
  for (const ExrChannel* channel : channels) layers[channel->layer].push_back(channel);
  std::vector<const ExrChannel*> found;
  std::vector<std::string> names;
  for (const auto& [name, members] : layers) {
    const ExrChannel* best = best_of(members, kind, axis);
    if (best == nullptr) continue;
    found.push_back(best);
    names.push_back(name.empty() ? "(no name)" : name);
  }
  if (found.empty()) return nullptr;
  if (found.size() == 1) return found.front();
  throw DataError(fmt::format("{} is in several layers: {}; expected the manifest's \"{}\" to name one",
                              found.front()->pass, list_names(names), choice));
}

}  // namespace thermal
