#include "raycast/ray_caster.h"

#include <algorithm>

#include "raycast/first_hit.h"
#include "raycast/frame_tracer.h"
#include "raycast/mirrors.h"
#include "raycast/refinement.h"
#include "raycast/scene_accelerator.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

std::vector<Piece> actors_in(const BakedScene& scene, const BakedMoment& now) {
  std::vector<Piece> pieces;
  std::size_t next = 0;
  for (std::size_t actor = 0; actor < scene.actors.size(); ++actor) {
    if (now.posed[actor] == 0) continue;
    const BakedActor& body = scene.actors[actor];
    for (const BakedBone& bone : body.bones) {
      Piece& piece = pieces.emplace_back();
      piece.mesh = static_cast<std::uint32_t>(bone.mesh);
      piece.object = body.object;
      std::ranges::transform(now.bones[next++], piece.to_world.begin(),
                             [](float entry) { return static_cast<double>(entry); });
    }
  }
  return pieces;
}

/// Gives pixels and samples both the mirrored planes, if either has them.
void even_out(Passes& passes) {
  if (passes.mirrored.empty() && !passes.fine.mirrored.empty())
    set_to_sky(passes.mirrored, passes.object_index.width_px(), passes.object_index.height_px());
  if (passes.fine.mirrored.empty() && !passes.mirrored.empty())
    set_to_sky(passes.fine.mirrored, passes.fine.object_index.size());
}

}  // namespace

RayCaster::RayCaster(const BakedScene& scene)
    : accelerator_(std::make_unique<const SceneAccelerator>(scene, FirstHitSearch::keep_first)) {}
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

CameraTracer::CameraTracer(const RayCaster& caster, const CameraIntrinsics& camera, const Sampling& sampling)
    : accelerator_(caster.accelerator()),
      pixel_rays_(std::make_unique<const PixelRays>(
          sampling.adaptive ? camera : finer(camera, sampling.supersample), sampling.lens)),
      sample_rays_(sampling.adaptive && sampling.supersample > 1
                       ? std::make_unique<const PixelRays>(finer(camera, sampling.supersample), sampling.lens)
                       : nullptr),
      supersample_(sampling.supersample) {}
CameraTracer::~CameraTracer() = default;

void CameraTracer::trace(const BakedMoment& now, const PassNeeds& needs, Passes& out) const {
  const PieceSet actors = accelerator_.set_of(actors_in(accelerator_.scene(), now));
  const Shot shot = {.accelerator = accelerator_, .actors = actors, .view = view_of(now.camera_to_world)};
  const Plane<std::uint8_t> near_actors = pixels_near(actors.pieces, accelerator_, shot.view, *pixel_rays_);
  const bool sees_water = may_see(accelerator_.waters(), accelerator_, shot.view, *pixel_rays_);
  PassNeeds of_samples = needs;
  of_samples.depth |= needs.depth_if_there;
  of_samples.mirrored &= sees_water;
  PassNeeds of_pixels = of_samples;
  of_pixels.depth |= sample_rays_ != nullptr;
  of_pixels.mirrored |= sample_rays_ != nullptr && sees_water;
  trace_pixels(shot, *pixel_rays_, near_actors, of_pixels, out);
  out.fine.factor = sample_rays_ ? supersample_ : 1;
  if (!sample_rays_) return;
  choose_pixels(out, near_actors, out.fine);
  trace_samples(shot, *sample_rays_, near_actors, of_samples, out.fine);
  if (of_samples.mirrored) even_out(out);
}

ClipTracer::ClipTracer(const RayCaster& caster, const BakedTrack& track, const CameraIntrinsics& camera,
                       const Sampling& sampling)
    : moments_(caster.accelerator().scene(), track), tracer_(caster, camera, sampling) {}

}  // namespace thermal
