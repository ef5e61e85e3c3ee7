#include "io/label_files/picture_names.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

using Places = std::vector<std::size_t>;  // of a video's pictures in the file

DataError fault_of_frame(const std::string& file, std::size_t place, const StatedImage& image,
                         const std::string& key, const std::string& rule) {
  return DataError(fault(fmt::format("{}: images[{}].{}", file, place, key),
                         image.frame ? std::to_string(*image.frame) : "nothing", "", rule));
}

void take_stated(const std::string& file, const Places& places, std::size_t first,
                 std::vector<StatedImage>& images) {
  std::map<int, std::size_t> seen;
  for (const std::size_t place : places) {
    StatedImage& image = images[place];
    if (!image.frame)
      throw fault_of_frame(file, place, image, images[first].frame_key,
                           fmt::format("one, as images[{}] of the same video has", first));
    const auto [there, fresh] = seen.emplace(*image.frame, place);
    if (!fresh)
      throw fault_of_frame(
          file, place, image, image.frame_key,
          fmt::format("a frame other than that of images[{}] of the same video", there->second));
    image.image.frame_index = *image.frame;
  }
}

/// Numbers pictures by names; returns whether names differ in numbers alone.
bool number_by_names(Places& places, std::vector<StatedImage>& images) {
  const auto name_of = [&images](std::size_t place) { return std::string_view(images[place].image.file); };
  std::ranges::stable_sort(places, [&name_of](std::size_t a, std::size_t b) {
    const int sign = compare_names(name_of(a), name_of(b)).sign;
    return sign != 0 ? sign < 0 : name_of(a) < name_of(b);
  });
  bool by_numbers = true;
  for (std::size_t k = 0; k < places.size(); ++k) {
    images[places[k]].image.frame_index = static_cast<int>(k);
    by_numbers &= k == 0 || compare_names(name_of(places[k - 1]), name_of(places[k])).by_number;
  }
  return by_numbers;
}

}  // namespace

void read_frame_of(const JsonEntry& entry, StatedImage& image) {
  for (const char* key : {"frame_index", "frame_id", "frame_num"}) {
    if (!entry.has(key)) continue;
    const int frame = entry.count(key);
    if (image.frame && frame != *image.frame)
      throw entry.fault_of(key, fmt::format("{}, the picture's {}", *image.frame, image.frame_key));
    if (!image.frame) image.frame_key = key;
    image.frame = frame;
  }
}

void order_frames(const std::string& file, std::vector<StatedImage>& images,
                  std::vector<LabelVideo>& videos) {
  std::vector<Places> of_video(videos.size());
  for (std::size_t place = 0; place < images.size(); ++place)
    of_video[images[place].image.video].push_back(place);
  for (std::size_t video = 0; video < videos.size(); ++video) {
    Places& places = of_video[video];
    const auto first = std::ranges::find_if(
        places, [&images](std::size_t place) { return images[place].frame.has_value(); });
    if (first == places.end())
      videos[video].in_time = number_by_names(places, images);
    else
      take_stated(file, places, *first, images);
  }
}

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
