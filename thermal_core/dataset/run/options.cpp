#include "dataset/run/options.h"

#include <algorithm>
#include <numeric>
#include <queue>
#include <set>
#include <utility>

namespace thermal {
namespace {

/// What an engine takes on two cores, conversion included [s].
struct Rates {
  double start_s;     ///< planning, baking, loading the scene, and Blender
  double per_clip_s;  ///< until the first frame
  double per_frame_s;
  double per_ray_s;  ///< of a pass pixel: traced and converted; with Blender, written and read in between
};

constexpr Rates kBlender = {.start_s = 35, .per_clip_s = 0.5, .per_frame_s = 0.05, .per_ray_s = 0.45e-6};
constexpr Rates kEmbree = {.start_s = 15, .per_clip_s = 0.1, .per_frame_s = 0.012, .per_ray_s = 0.055e-6};
/// Pixels that get all rays beside their first with adaptive sampling, as far as their time goes: these rays take longer
/// than others, because they meet the edges of plants. With 2 x 2, 0.7 of the time of all rays is left.
constexpr double kRefinedShare = 0.45;
constexpr double kBytesPerPixel = 2.2;  ///< both pictures and the preview

double rays_per_pixel(const DatasetSpec& spec) {
  const double all = 1.0 * spec.supersample * spec.supersample;
  return spec.adaptive_sampling && spec.supersample > 1 ? 1 + kRefinedShare * all : all;
}

const Rates& rates_of(const DatasetSpec& spec) { return spec.engine == Engine::embree ? kEmbree : kBlender; }

double frame_seconds(const DatasetSpec& spec) {
  const double rays = rays_per_pixel(spec) * (spec.width_px + 2.0 * spec.overscan_px) *
                      (spec.height_px + 2.0 * spec.overscan_px);
  return rates_of(spec).per_frame_s + rays * rates_of(spec).per_ray_s;
}

}  // namespace

double clip_seconds(const DatasetSpec& spec, int frames) {
  return rates_of(spec).per_clip_s + frames * frame_seconds(spec);
}

Estimate estimate_run(const DatasetSpec& spec, int clips, int frames) {
  const double pixels = static_cast<double>(spec.width_px) * spec.height_px;
  return {
      .seconds = rates_of(spec).start_s + clips * rates_of(spec).per_clip_s + frames * frame_seconds(spec),
      .bytes = frames * pixels * kBytesPerPixel};
}

std::vector<int> deal_shards(const DatasetSpec& spec, int count) {
  std::vector<std::size_t> order(spec.clips.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return spec.clips[a].frames > spec.clips[b].frames; });
  using Load = std::pair<double, int>;  // seconds, shard; of equal loads the first shard is next
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (int shard = 0; shard < count; ++shard) loads.emplace(0.0, shard);
  std::vector<int> shards(spec.clips.size());
  for (const std::size_t place : order) {
    const auto [seconds, shard] = loads.top();
    loads.pop();
    shards[place] = shard;
    loads.emplace(seconds + clip_seconds(spec, spec.clips[place].frames), shard);
  }
  return shards;
}

std::vector<ClipSpec> choose_clips(const DatasetSpec& spec, const std::vector<std::string>& ids,
                                   const Shard& shard) {
  for (const std::string& id : ids) (void)spec.clip(id, "--clips");
  const std::vector<int> shards = deal_shards(spec, shard.count);
  std::vector<ClipSpec> chosen;
  for (std::size_t i = 0; i < spec.clips.size(); ++i) {
    const ClipSpec& clip = spec.clips[i];
    const bool named = ids.empty() || std::find(ids.begin(), ids.end(), clip.id) != ids.end();
    if (named && shards[i] == shard.index) chosen.push_back(clip);
  }
  return chosen;
}

std::vector<std::string> ids_of(const std::vector<ClipSpec>& clips) {
  std::vector<std::string> ids;
  for (const ClipSpec& clip : clips) ids.push_back(clip.id);
  return ids;
}

int frames_of(const std::vector<ClipSpec>& clips) {
  int frames = 0;
  for (const ClipSpec& clip : clips) frames += clip.frames;
  return frames;
}

std::vector<std::size_t> places_of(const std::vector<std::string>& some,
                                   const std::vector<std::string>& all) {
  const std::set<std::string> ids(some.begin(), some.end());
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (ids.contains(all[i])) places.push_back(i);
  return places;
}

}  // namespace thermal
