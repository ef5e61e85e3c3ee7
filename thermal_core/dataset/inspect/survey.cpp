#include "dataset/inspect/survey.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/plausible.h"
#include "dataset/clip/frame_faults.h"
#include "io/exr/planes.h"
#include "labels/instances.h"

namespace thermal {
namespace {

std::string name_of(const ExrChannel* channel) { return channel == nullptr ? "" : channel->full_name(); }

void count(const Plane<std::uint16_t>& plane, std::map<int, std::int64_t>& pixels) {
  if (plane.empty()) return;
  for (const IndexUse& use : survey_indices(plane)) pixels[use.index] += use.pixels;
}

bool could_be_index(float value) noexcept {
  return value >= 0 && value <= static_cast<float>(kLargestIndex) && value == std::floor(value);
}

bool is_candidate(const ExrChannel& channel) {
  static constexpr std::array<std::string_view, 8> kColours = {"R", "G", "B", "A", "r", "g", "b", "a"};
  const bool colour = std::find(kColours.begin(), kColours.end(), channel.component) != kColours.end() ||
                      std::find(kColours.begin(), kColours.end(), channel.pass) != kColours.end();
  return !colour && !pass_kind_of(channel.pass).has_value();
}

bool could_be_indices(const Plane<float>& plane) {
  const auto pixels = plane.pixels();
  const auto [least, most] = std::minmax_element(pixels.begin(), pixels.end());
  return *least != *most && std::all_of(pixels.begin(), pixels.end(), could_be_index);
}

/// Whether these channels all hold the same indices. False also for channels that cannot be read.
bool hold_indices(const Path& file, const ExrHeader& header, const std::vector<const ExrChannel*>& channels,
                  const ReadLimits& limits) {
  try {
    const auto planes = read_exr_channels(file, header, channels, 0, {.pixels = limits.pixels});
    return could_be_indices(planes.front()) &&
           std::ranges::all_of(planes, [&](const Plane<float>& plane) { return plane == planes.front(); });
  } catch (const Error&) {  // reported by the survey
    return false;
  }
}

}  // namespace

PassSurveyor::PassSurveyor(ExrLayout layout, ReadLimits limits)
    : layout_(std::move(layout)), limits_(limits) {
  layout_.limits.pixels = limits.pixels;
}

void PassSurveyor::add(const Path& file) {
  try {
    is_index_picture(file) ? add_picture(file) : add_exr(file);
    ++survey_.frames;
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    survey_.bad_frames.push_back(
        {.file = file.filename().string(), .reason = without_name(error.what(), file)});
  }
}

void PassSurveyor::add_picture(const Path& file) {
  const PictureSurvey found = survey_picture(file, limits_);
  for (const PictureUse& use : found.uses) {
    if (found.kind == PictureKind::colour) {
      survey_.colours[use.colour] += use.pixels;
    } else {
      survey_.objects[use.value] += use.pixels;
    }
  }
  survey_.uncounted_pixels += found.transparent_pixels + found.other_pixels;
}

void PassSurveyor::add_exr(const Path& file) {
  const ExrHeader header = read_exr_header(file, layout_.limits);
  add_mattes(file, header);
  add_planes(file, header);
}

void PassSurveyor::add_planes(const Path& file, const ExrHeader& header) {
  PassNeeds needs;
  try {
    needs.depth = !choose_planes(header, layout_).depth.empty();
  } catch (const DataError&) {  // no object index: there may still be a depth
    const ExrChannel* depth = header.find_depth(layout_.layer);
    if (depth != nullptr) add_depth(read_exr_channel(file, header, *depth, kSkyDepthM, layout_.limits));
    return;
  }
  const Passes passes = read_passes(file, layout_, needs);
  count(passes.object_index, survey_.objects);
  count(passes.material_index, survey_.materials);
  add_depth(passes.depth_m);
}

void PassSurveyor::add_mattes(const Path& file, const ExrHeader& header) {
  for (const Cryptomatte& cryptomatte : cryptomattes_in(header)) {
    if (!cryptomatte.fault.empty()) continue;
    auto& found = survey_.cryptomattes[cryptomatte.name];
    for (const MatteUse& use : survey_mattes(file, header, cryptomatte, layout_.limits)) {
      found[use.hash].name = use.name;
      found[use.hash].pixels += use.pixels;
    }
    add_lower_ranks(file, header, cryptomatte);
  }
}

/// Adds objects that never cover most of a pixel, because a conversion must know them.
void PassSurveyor::add_lower_ranks(const Path& file, const ExrHeader& header,
                                   const Cryptomatte& cryptomatte) {
  auto& found = survey_.cryptomattes[cryptomatte.name];
  const std::vector<const ExrChannel*> lower(cryptomatte.channels.begin() + 2, cryptomatte.channels.end());
  const std::vector<Plane<float>> planes = read_exr_channels(file, header, lower, 0, layout_.limits);
  for (std::size_t rank = 0; rank + 1 < planes.size(); rank += 2) {
    for (std::size_t i = 0; i < planes[rank].size(); ++i) {
      if (!(planes[rank + 1].pixels()[i] > 0)) continue;
      const auto hash = std::bit_cast<std::uint32_t>(planes[rank].pixels()[i]);
      if (found.contains(hash) || found.size() >= kMostMattes) continue;
      const auto named = cryptomatte.names.find(hash);
      found[hash].name = named == cryptomatte.names.end() ? "" : named->second;
    }
  }
}

void PassSurveyor::add_depth(const Plane<float>& depth_m) {
  for (const float value : depth_m.pixels()) {
    if (!kDistanceM.holds(static_cast<double>(value))) continue;
    if (!survey_.depth) survey_.depth = {.nearest_m = value, .farthest_m = value};
    survey_.depth->nearest_m = std::min(survey_.depth->nearest_m, value);
    survey_.depth->farthest_m = std::max(survey_.depth->farthest_m, value);
  }
}

ChosenPlanes choose_planes(const ExrHeader& header, const ExrLayout& layout) {
  const ExrPlanes planes(header, layout);
  return {.objects = name_of(&planes.objects()),
          .materials = name_of(planes.materials()),
          .depth = name_of(planes.depth()),
          .normals = name_of(planes.normal("X"))};
}

std::vector<std::string> likely_indices(const Path& file, const ExrHeader& header, const ReadLimits& limits) {
  std::vector<std::string> names;
  for (const ExrChannel& channel : header.channels)
    if (is_candidate(channel) && hold_indices(file, header, {&channel}, limits))
      names.push_back(channel.full_name());
  for (const auto& picture : pictures_in(header))
    if (hold_indices(file, header, {picture.begin(), picture.end()}, limits))
      names.push_back(picture.front()->full_name());
  return names;
}

}  // namespace thermal
