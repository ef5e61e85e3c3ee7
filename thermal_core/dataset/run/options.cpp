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

double rays_per_pixel(const Config& config) {
  const double all = 1.0 * config.supersample * config.supersample;
  return config.adaptive_sampling && config.supersample > 1 ? 1 + kRefinedShare * all : all;
}

const Rates& rates_of(const Config& config) { return config.engine == Engine::embree ? kEmbree : kBlender; }

double frame_seconds(const Config& config) {
  const double rays = rays_per_pixel(config) * (config.width_px + 2.0 * config.overscan_px) *
                      (config.height_px + 2.0 * config.overscan_px);
  return rates_of(config).per_frame_s + rays * rates_of(config).per_ray_s;
}

}  // namespace

double clip_seconds(const Config& config, int frames) {
  return rates_of(config).per_clip_s + frames * frame_seconds(config);
}

Estimate estimate_run(const Config& config, int clips, int frames) {
  const double pixels = static_cast<double>(config.width_px) * config.height_px;
  return {.seconds =
              rates_of(config).start_s + clips * rates_of(config).per_clip_s + frames * frame_seconds(config),
          .bytes = frames * pixels * kBytesPerPixel};
}

std::vector<int> deal_shards(const Config& config, int count) {
  std::vector<std::size_t> order(config.clips.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return config.clips[a].frames > config.clips[b].frames; });
  using Load = std::pair<double, int>;  // seconds, shard; of equal loads the first shard is next
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (int shard = 0; shard < count; ++shard) loads.emplace(0.0, shard);
  std::vector<int> shards(config.clips.size());
  for (const std::size_t place : order) {
    const auto [seconds, shard] = loads.top();
    loads.pop();
    shards[place] = shard;
    loads.emplace(seconds + clip_seconds(config, config.clips[place].frames), shard);
  }
  return shards;
}

std::vector<ClipConfig> choose_clips(const Config& config, const std::vector<std::string>& ids,
                                     const Shard& shard) {
  for (const std::string& id : ids) (void)config.clip(id, "--clips");
  const std::vector<int> shards = deal_shards(config, shard.count);
  std::vector<ClipConfig> chosen;
  for (std::size_t i = 0; i < config.clips.size(); ++i) {
    const ClipConfig& clip = config.clips[i];
    const bool named = ids.empty() || std::find(ids.begin(), ids.end(), clip.id) != ids.end();
    if (named && shards[i] == shard.index) chosen.push_back(clip);
  }
  return chosen;
}

std::vector<std::string> ids_of(const std::vector<ClipConfig>& clips) {
  std::vector<std::string> ids;
  for (const ClipConfig& clip : clips) ids.push_back(clip.id);
  return ids;
}

int frames_of(const std::vector<ClipConfig>& clips) {
  int frames = 0;
  for (const ClipConfig& clip : clips) frames += clip.frames;
  return frames;
}

std::vector<std::size_t> places_of(const Config& config, const std::vector<ClipConfig>& clips) {
  const std::vector<std::string> listed = ids_of(clips);
  const std::set<std::string> ids(listed.begin(), listed.end());
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < config.clips.size(); ++i) {
    if (ids.contains(config.clips[i].id)) places.push_back(i);
  }
  return places;
}

}  // namespace thermal
