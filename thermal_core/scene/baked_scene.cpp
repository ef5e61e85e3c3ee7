#include "scene/baked_scene.h"

#include <cassert>
#include <cmath>

namespace thermal {
namespace {

/// A track stores transforms by actor, then frame, then bone.
std::vector<std::size_t> first_bones(const BakedScene& scene, const BakedTrack& track) {
  std::vector<std::size_t> first;
  first.reserve(track.posed.size());
  std::size_t next = 0;
  for (std::size_t k = 0; k < track.posed.size(); ++k) {
    first.push_back(next);
    if (track.posed[k] != 0) next += scene.actors[k / track.frames].bones.size();
  }
  return first;
}

template <typename Numbers>
Numbers between(const Numbers& from, const Numbers& to, double share) {
  using Number = typename Numbers::value_type;
  Numbers out{};
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = static_cast<Number>(std::lerp(static_cast<double>(from[i]), static_cast<double>(to[i]), share));
  return out;
}

}  // namespace

TrackMoments::TrackMoments(const BakedScene& scene, const BakedTrack& track)
    : scene_(scene), track_(track), first_bone_(first_bones(scene, track)) {}

BakedMoment TrackMoments::at_frame(std::size_t frame) const {
  BakedMoment now;
  now.camera_to_world = track_.camera_to_world[frame];
  for (std::size_t actor = 0; actor < scene_.actors.size(); ++actor) {
    const std::size_t k = moment(actor, frame);
    now.actor_position_m.push_back(track_.actor_position_m[k]);
    now.actor_heading_rad.push_back(track_.actor_heading_rad[k]);
    now.posed.push_back(track_.posed[k]);
    if (track_.posed[k] == 0) continue;
    const auto bones = track_.bones.subspan(first_bone_[k], scene_.actors[actor].bones.size());
    now.bones.insert(now.bones.end(), bones.begin(), bones.end());
  }
  return now;
}

BakedMoment TrackMoments::at_time(double time_s) const {
  assert(track_.time_s.front() <= time_s && time_s <= track_.time_s.back());
  const auto after = std::ranges::upper_bound(track_.time_s, time_s);
  const auto frame = static_cast<std::size_t>(after - track_.time_s.begin()) - 1;
  BakedMoment now = at_frame(frame);
  if (track_.time_s[frame] == time_s || frame + 1 == track_.frames) return now;
  const double share = (time_s - track_.time_s[frame]) / (track_.time_s[frame + 1] - track_.time_s[frame]);
  now.bones.clear();
  for (std::size_t actor = 0; actor < scene_.actors.size(); ++actor) {
    const std::size_t from = moment(actor, frame);
    const std::size_t to = from + 1;
    now.actor_position_m[actor] = between(track_.actor_position_m[from], track_.actor_position_m[to], share);
    now.actor_heading_rad[actor] +=
        share * std::remainder(track_.actor_heading_rad[to] - track_.actor_heading_rad[from], 2 * M_PI);
    now.posed[actor] = track_.posed[from] & track_.posed[to];
    if (now.posed[actor] == 0) continue;
    for (std::size_t bone = 0; bone < scene_.actors[actor].bones.size(); ++bone)
      now.bones.push_back(
          between(track_.bones[first_bone_[from] + bone], track_.bones[first_bone_[to] + bone], share));
  }
  return now;
}

}  // namespace thermal
