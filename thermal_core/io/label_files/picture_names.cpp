#include "io/label_files/picture_names.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

std::string with_slashes(std::string name) {
  std::ranges::replace(name, '\\', '/');
  return name;
}

std::string last_part(const std::string& name) { return name.substr(name.find_last_of('/') + 1); }

/// Whether the last folders and the file name of `whole` are `end`.
bool ends_with(const std::string& whole, const std::string& end) {
  return whole == end || whole.ends_with("/" + end);
}

}  // namespace

std::string name_without_ending(std::string name) {
  name = with_slashes(std::move(name));
  const std::size_t dot = name.find_last_of('.');
  return dot == std::string::npos || dot < name.find_last_of('/') + 2 ? name : name.substr(0, dot);
}

PictureNames::PictureNames(const LabelSet& set) : set_(set) {
  Places alone;
  for (std::size_t i = 0; i < set.images.size(); ++i) {
    const std::string name = name_without_ending(set.images[i].file);
    add(alone, last_part(name), i);
    add(places_, flat_name(set, set.images[i]), i);
    if (name.find('/') != std::string::npos) add(places_, name, i);
  }
  std::erase_if(alone, [](const auto& named) { return named.second.other.has_value(); });
  places_.merge(alone);
}

void PictureNames::add(Places& places, const std::string& name, std::size_t image) {
  const auto [there, fresh] = places.try_emplace(name, Place{.image = image});
  if (!fresh && there->second.image != image) there->second.other = image;
}

std::optional<std::size_t> PictureNames::find(const std::string& name, const std::string& where) const {
  const std::string whole = with_slashes(name);
  for (const std::string& plain : {whole, name_without_ending(whole)}) {
    for (const std::string& form : {plain, last_part(plain)}) {
      const auto found = places_.find(form);
      if (found == places_.end()) continue;
      const auto& [image, other] = found->second;
      if (other)
        throw DataError(fmt::format("{}: \"{}\" is both {} and {}; expected names that differ", where, form,
                                    set_.images[image].file, set_.images[*other].file));
      if (is_name_of(plain, image)) return image;
    }
  }
  return {};
}

bool PictureNames::is_name_of(const std::string& name, std::size_t image) const {
  const std::string own = name_without_ending(set_.images[image].file);
  const std::string flat = flat_name(set_, set_.images[image]);
  const std::string whole = with_slashes(name);
  return std::ranges::any_of(std::array{whole, name_without_ending(whole)}, [&](const std::string& plain) {
    return ends_with(own, plain) || ends_with(plain, own) || last_part(plain) == flat;
  });
}

std::string PictureNames::suggestion_for(const std::string& name) const {
  std::vector<std::string> names;
  for (const auto& [known, place] : places_) names.push_back(known);
  return did_you_mean(name, names);
}

}  // namespace thermal
