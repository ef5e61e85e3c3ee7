#include "dataset/live/world.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "dataset/clip/heat_days.h"
#include "dataset/outline/outline.h"
#include "dataset/run/tracing.h"
#include "io/config/materials.h"
#include "raycast/vectors.h"

namespace thermal {
namespace {

PlannedDataset checked_plan(const PlanStore& store) {
  PlannedDataset planned = store.open();
  const std::string where = store.config_file().string() + ": ";
  if (planned.config.spec.engine != Engine::embree)
    throw ConfigError(where + fault("render.engine", "\"blender\"", "", "\"embree\""));
  if (!planned.config.spec.poses_all)
    throw ConfigError(where + fault("render.posed_actors", "\"seen\"", "", "\"all\""));
  return planned;
}

/// The camera on the horizon, from where all of the ground is seen.
std::array<double, 16> levelled(std::array<double, 16> pose) {
  constexpr std::array<std::array<double, 3>, 3> kNorthwards = {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};
  for (std::size_t row = 0; row < 3; ++row)
    std::ranges::copy(kNorthwards[row], pose.begin() + static_cast<std::ptrdiff_t>(4 * row));
  return pose;
}

Manifest manifest_for(const DatasetSpec& spec, const ClipSpec& clip, const BakedScene& scene,
                      const BakedTrack& track, const WorldOptions& options) {
  Manifest manifest = manifest_of(scene, track, spec, clip);
  if (options.frame_rate_hz) manifest.frame_rate_hz = *options.frame_rate_hz;
  if (options.roam) {
    ManifestFrame all_ground = manifest.frames.back();
    all_ground.camera_to_world = levelled(*all_ground.camera_to_world);
    manifest.frames.push_back(std::move(all_ground));
  }
  return manifest;
}

std::unique_ptr<LiveClip> clip_for(const PlannedDataset& planned, const ClipSpec& clip,
                                   const PlanStore& store, const BakedScene& scene, Manifest manifest,
                                   const Assets& assets) {
  const DatasetSpec& spec = planned.config.spec;
  auto materials = std::make_shared<const MaterialLibrary>(read_materials(assets));
  const KeptTerms kept(spec, outline_of(spec, planned.plan, *materials));
  HeatDays heat(*materials);
  ClipTask task = task_of(spec, clip, kept.of(clip), heat, store.ground_maps(spec, scene));
  return std::make_unique<LiveClip>(std::move(manifest), std::move(materials), std::move(task));
}

/// ConfigError unless a pose is a rotation and a place near the scene, where single precision resolves centimetres.
void check_pose(const std::array<double, 16>& pose) {
  constexpr double kOff = 1e-6;
  constexpr double kFarthestM = 100'000;
  const auto at = [&pose](std::size_t row, std::size_t column) { return pose[4 * row + column]; };
  bool good = std::ranges::all_of(pose, [](double entry) { return std::isfinite(entry); });
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double product = at(0, i) * at(0, j) + at(1, i) * at(1, j) + at(2, i) * at(2, j);
      good = good && std::abs(product - (i == j ? 1 : 0)) <= kOff;
    }
    good = good && at(3, i) == 0 && std::abs(at(i, 3)) <= kFarthestM;
  }
  const double handedness = at(0, 0) * (at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)) -
                            at(0, 1) * (at(1, 0) * at(2, 2) - at(1, 2) * at(2, 0)) +
                            at(0, 2) * (at(1, 0) * at(2, 1) - at(1, 1) * at(2, 0));
  if (good && handedness > 0 && at(3, 3) == 1) return;
  throw ConfigError(fault("camera_to_world", fmt::format("[{}]", fmt::join(pose, ", ")), "",
                          "a rotation and a place within 100 km [m] in four rows of four"));
}

Vector3 unit(const Vector3& axis) { return (1 / length(axis)) * axis; }

/// A pose at a share of the way between two that look nearly alike.
std::array<double, 16> pose_between(const std::array<double, 16>& from, const std::array<double, 16>& to,
                                    double share) {
  std::array<double, 16> pose{};
  for (std::size_t k = 0; k < pose.size(); ++k) pose[k] = from[k] + share * (to[k] - from[k]);
  const auto column = [&pose](std::size_t k) { return Vector3{pose[k], pose[4 + k], pose[8 + k]}; };
  const Vector3 forward = unit(column(2));
  const Vector3 down = unit(cross(forward, column(0)));
  const Vector3 right = cross(down, forward);
  const std::array<Vector3, 3> axes = {right, down, forward};
  for (std::size_t k = 0; k < axes.size(); ++k) {
    pose[k] = axes[k].x;
    pose[4 + k] = axes[k].y;
    pose[8 + k] = axes[k].z;
  }
  return pose;
}

}  // namespace

World::World(const Path& plan, const std::string& clip, const Assets& assets, const WorldOptions& options)
    : World(checked_plan({plan, assets}), {plan, assets}, clip, assets, options) {}

World::World(const PlannedDataset& planned, const PlanStore& store, const std::string& clip,
             const Assets& assets, const WorldOptions& options)
    : scene_(store.scene(planned.config.spec)),
      track_(store.track(planned.config.spec.clip(clip, "clip"), scene_)),
      caster_(scene_),
      moments_(scene_, track_) {
  if (options.frame_rate_hz && !(*options.frame_rate_hz > 0 && std::isfinite(*options.frame_rate_hz)))
    throw ConfigError(fault("frame_rate_hz", fmt::format("{}", *options.frame_rate_hz), "Hz", "above 0"));
  const DatasetSpec& spec = planned.config.spec;
  const ClipSpec& own = spec.clip(clip, "clip");
  clip_ = clip_for(planned, own, store, scene_, manifest_for(spec, own, scene_, track_, options), assets);
  tracer_ = std::make_unique<const CameraTracer>(caster_, clip_->manifest().camera,
                                                 Sampling{.supersample = spec.supersample,
                                                          .adaptive = spec.adaptive_sampling,
                                                          .lens = clip_->manifest().lens});
  needs_ = clip_->needs();
}

World::~World() = default;

const ClipImager::Frame& World::capture(const std::array<double, 16>& camera_to_world, double time_s) {
  check_pose(camera_to_world);
  const int number = number_at(time_s);
  BakedMoment now = moments_.at_time(known_time(time_s));
  now.camera_to_world = camera_to_world;
  tracer_->trace(now, needs_, passes_);
  frame_ = manifest_frame_of(scene_, now, time_s);
  next_ = number + 1;
  // A first frame has none before it: the planned one smears by the next, as `generate` has it.
  const ManifestFrame& first = clip_->manifest().frames.front();
  if (number == 0 && frame_.camera_to_world == first.camera_to_world) return clip_->make(passes_, 0);
  return clip_->make(passes_, frame_, number);
}

std::array<double, 16> World::flight_pose_at(double time_s) const {
  const double known_s = known_time(time_s);
  const auto after = std::ranges::lower_bound(track_.time_s, known_s);
  const auto next = static_cast<std::size_t>(after - track_.time_s.begin());
  if (*after == known_s) return track_.camera_to_world[next];
  const double share = (known_s - track_.time_s[next - 1]) / (track_.time_s[next] - track_.time_s[next - 1]);
  return pose_between(track_.camera_to_world[next - 1], track_.camera_to_world[next], share);
}

void World::restart(std::uint32_t seed) {
  clip_->restart(seed);
  next_ = 0;
}

/// ConfigError unless it is on the camera's clock, and not before the next frame or after the last.
int World::number_at(double time_s) const {
  constexpr double kOffClock = 1e-3;  // of a frame
  const double frames = (time_s - track_.time_s.front()) * frame_rate_hz();
  const double last = (track_.time_s.back() - track_.time_s.front()) * frame_rate_hz();
  const double number = std::nearbyint(frames);
  if (std::abs(frames - number) <= kOffClock && number >= next_ && number <= last + kOffClock)
    return static_cast<int>(number);
  throw ConfigError(fault("time_s", fmt::format("{}", time_s), "s",
                          fmt::format("from {} s to {} s, a whole number of frames of 1/{} s after {} s",
                                      track_.time_s.front() + next_ / frame_rate_hz(), track_.time_s.back(),
                                      frame_rate_hz(), track_.time_s.front())));
}

/// That of a planned frame where it is nearly the same, and within the track.
double World::known_time(double time_s) const {
  constexpr double kSameS = 1e-9;
  const auto near = std::ranges::lower_bound(track_.time_s, time_s - kSameS);
  const bool same = near != track_.time_s.end() && std::abs(*near - time_s) <= kSameS;
  return std::clamp(same ? *near : time_s, track_.time_s.front(), track_.time_s.back());
}

}  // namespace thermal
