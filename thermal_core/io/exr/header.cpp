#include "io/exr/header.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <string_view>
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

namespace {

/// Channel of a pass in a layer, or in the only layer that has it.
const ExrChannel* find_pass(const ExrHeader& header, const std::string& layer, PassKind kind,
                            std::string_view axis = "") {
  std::vector<const ExrChannel*> channels;
  for (const ExrChannel& channel : header.channels) {
    if (layer.empty() || channel.layer == layer) channels.push_back(&channel);
  }
  return only_best_of(channels, kind, axis, "layer");
}

}  // namespace

const ExrChannel* ExrHeader::find_object_index(const std::string& layer) const {
  return find_pass(*this, layer, PassKind::object_index);
}

const ExrChannel* ExrHeader::find_material_index(const std::string& layer) const {
  return find_pass(*this, layer, PassKind::material_index);
}

const ExrChannel* ExrHeader::find_depth(const std::string& layer) const {
  return find_pass(*this, layer, PassKind::depth);
}

const ExrChannel* ExrHeader::find_normal(const std::string& layer, const std::string& component) const {
  return find_pass(*this, layer, PassKind::normal, component);
}

namespace {

using Words = std::vector<std::string>;

/// Joins non-empty words by dots.
std::string joined(const Words& words) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty() && !word.empty()) text += '.';
    text += word;
  }
  return text;
}

Words words_of(const std::string& name) {
  Words words;
  for (const std::string_view word : split(name, '.')) words.emplace_back(word);
  return words;
}

/// The component letter of a word, or empty. Nuke names components of layers red, green, blue and alpha.
std::string component_in(const std::string& word) {
  static const std::map<std::string_view, std::string> kColours = {
      {"red", "R"}, {"green", "G"}, {"blue", "B"}, {"alpha", "A"}};
  if (word.size() == 1) return word;
  const auto colour = kColours.find(word);
  return colour == kColours.end() ? "" : colour->second;
}

/// Removes the component, unless it is the whole name.
std::string take_component(Words& words) {
  if (words.size() < 2) return "";
  std::string component = component_in(words.back());
  if (!component.empty()) words.pop_back();
  return component;
}

/// Removes the name of a view, unless it is the whole name.
std::string take_view(Words& words, const Words& views) {
  const auto is_view = [&](const std::string& word) {
    return std::find(views.begin(), views.end(), word) != views.end();
  };
  const auto word = std::find_if(words.begin(), words.end(), is_view);
  if (word == words.end() || words.size() == 1) return "";
  std::string view = *word;
  words.erase(word);
  return view;
}

/// A part's name without its view's: Blender writes "Scene.Depth-left", others "Scene.Depth.left".
std::string without_view(const std::string& part, const std::string& view) {
  constexpr std::string_view kBetween = "-._ ";
  if (view.empty() || !part.ends_with(view)) return part;
  std::string rest = part.substr(0, part.size() - view.size());
  if (rest.empty()) return rest;
  if (kBetween.find(rest.back()) == std::string_view::npos) return part;
  rest.pop_back();
  return rest;
}

/// The words of a channel's name, preceded by its part's unless it has a layer of its own.
Words words_with_part(const std::string& channel, const ExrParts::Part& part) {
  Words words = words_of(channel);
  Words named = words;
  (void)take_component(named);
  if (named.size() > 1) return words;
  Words whole = words_of(without_view(part.name, part.view));
  const bool repeats = words.size() > 1 && whole.back() == words.front();  // part Depth, channel Depth.Z
  if (repeats) whole.pop_back();
  whole.insert(whole.end(), words.begin(), words.end());
  std::erase(whole, "");
  return whole.empty() ? Words{""} : whole;
}

struct Parsed {
  Words layer;
  std::string pass;
  std::string component;
  std::string view;

  [[nodiscard]] std::string identity(const std::string& end) const {
    return joined({joined(layer), pass, view, end});
  }
};

Parsed parse(const ExrChannel& channel, const ExrParts::Part& part, const Words& views) {
  Words words = words_with_part(channel.name, part);
  Parsed parsed;
  parsed.component = take_component(words);
  parsed.view = take_view(words, views);
  if (parsed.view.empty()) parsed.view = part.view;
  parsed.pass = words.back();
  words.pop_back();
  parsed.layer = std::move(words);
  return parsed;
}

/// "Scene.Z" is parsed as component Z of a pass called Scene, which is wrong if Scene is a layer.
void settle_lone_depths(std::vector<Parsed>& channels) {
  std::set<std::string> stems;
  for (const Parsed& channel : channels) {
    stems.insert(joined({joined(channel.layer), channel.view}));
    stems.insert(channel.identity(upper_case(channel.component)));
  }
  for (Parsed& channel : channels) {
    if (upper_case(channel.component) != "Z" || pass_kind_of(channel.pass)) continue;
    const bool is_layer = stems.contains(channel.identity("")) || stems.contains(channel.identity("R"));
    if (!is_layer || stems.contains(channel.identity("X"))) continue;
    channel.layer.push_back(channel.pass);
    channel.pass = channel.component;
    channel.component.clear();
  }
}

std::string part_name(const ExrParts& file, const ExrChannel& channel) {
  const std::string& name = file.parts.at(static_cast<std::size_t>(channel.part)).name;
  return name.empty() ? fmt::format("part {}", channel.part) : name;
}

/// Channels of several parts with equal names are put in layers of their parts' names.
void separate_parts(std::vector<ExrChannel>& channels, const ExrParts& file) {
  std::map<std::string, int> uses;
  for (const ExrChannel& channel : channels) ++uses[channel.full_name()];
  for (ExrChannel& channel : channels) {
    if (uses[channel.full_name()] > 1) channel.layer = joined({part_name(file, channel), channel.layer});
  }
}

/// Views and names of the parts, each only if there are several.
ExrParts telling(ExrParts file) {
  std::set<std::string> views;
  for (const ExrParts::Part& part : file.parts) views.insert(part.view);
  for (ExrParts::Part& part : file.parts) {
    if (views.size() == 1) part.view.clear();
    if (file.parts.size() == 1) part.name.clear();
  }
  return file;
}

}  // namespace

void name_channels(std::vector<ExrChannel>& channels, const ExrParts& file) {
  const ExrParts file_parts = telling(file);
  std::vector<Parsed> parsed;
  parsed.reserve(channels.size());
  for (const ExrChannel& channel : channels)
    parsed.push_back(
        parse(channel, file_parts.parts.at(static_cast<std::size_t>(channel.part)), file_parts.views));
  settle_lone_depths(parsed);
  for (std::size_t i = 0; i < channels.size(); ++i) {
    channels[i].layer = joined({joined(parsed[i].layer), parsed[i].view});
    channels[i].pass = parsed[i].pass;
    channels[i].component = parsed[i].component;
  }
  separate_parts(channels, file_parts);
}

std::vector<std::array<const ExrChannel*, 3>> pictures_in(const ExrHeader& header) {
  const auto colour_of = [](const ExrChannel& channel) {
    return upper_case(channel.component.empty() ? channel.pass : channel.component);
  };
  const auto beside = [&](const ExrChannel& red, const char* colour) {
    const auto found = std::ranges::find_if(header.channels, [&](const ExrChannel& channel) {
      const bool same_pass = channel.component.empty() ? red.component.empty() : channel.pass == red.pass;
      return same_pass && channel.layer == red.layer && colour_of(channel) == colour;
    });
    return found == header.channels.end() ? nullptr : &*found;
  };
  std::vector<std::array<const ExrChannel*, 3>> pictures;
  for (const ExrChannel& red : header.channels) {
    if (colour_of(red) != "R") continue;
    const std::array picture = {&red, beside(red, "G"), beside(red, "B")};
    if (picture[1] != nullptr && picture[2] != nullptr) pictures.push_back(picture);
  }
  return pictures;
}

bool has_bare_name(const ExrChannel& channel) {
  Words words = words_of(channel.name);
  (void)take_component(words);
  return words.size() == 1;
}

std::string ExrChannel::full_name() const { return joined({layer, pass, component}); }

std::vector<std::string> full_names(const std::vector<ExrChannel>& channels) {
  std::vector<std::string> names;
  names.reserve(channels.size());
  for (const ExrChannel& channel : channels) names.push_back(channel.full_name());
  return names;
}

}  // namespace thermal
