#include "dataset/run/clip_choice.h"

#include <algorithm>
#include <set>

namespace thermal {

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
