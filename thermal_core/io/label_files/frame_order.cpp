#include "io/label_files/frame_order.h"

#include <algorithm>
#include <map>

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

}  // namespace thermal
