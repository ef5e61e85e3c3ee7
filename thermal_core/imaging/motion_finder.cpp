#include "imaging/motion_finder.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/clones.h"
#include "base/parallel.h"

namespace thermal {
namespace {

constexpr std::size_t kMotionRowsPerChunk = 16;
constexpr float kMostMotionPx = 4096;
constexpr float kApartPx = 0.25F;  // least difference between the motions of an actor and its background
constexpr int kLongestTrailPx = 256;

using Matrix = std::array<double, 9>;
using Vector = std::array<double, 3>;

/// A rigid motion: rotation `turn`, then `shift`.
struct Rigid {
  Matrix turn{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vector shift{};
};

Vector turned(const Matrix& m, const Vector& v) {
  return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
          m[6] * v[0] + m[7] * v[1] + m[8] * v[2]};
}

Matrix transposed(const Matrix& m) { return {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]}; }

/// Composition: `first`, then `next`.
Rigid then(const Rigid& first, const Rigid& next) {
  Rigid both;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += next.turn.at(3 * row + k) * first.turn.at(3 * k + column);
      both.turn.at(3 * row + column) = sum;
    }
  }
  both.shift = turned(next.turn, first.shift);
  for (std::size_t i = 0; i < 3; ++i) both.shift.at(i) += next.shift.at(i);
  return both;
}

Rigid inverse(const Rigid& motion) {
  Rigid back{.turn = transposed(motion.turn)};
  back.shift = turned(back.turn, motion.shift);
  for (double& value : back.shift) value = -value;
  return back;
}

Rigid rigid_of(const std::array<double, 16>& m) {
  return {.turn = {m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]}, .shift = {m[3], m[7], m[11]}};
}

Rigid rigid_of(const ActorPose& pose) {
  const double c = std::cos(pose.heading_rad);
  const double s = std::sin(pose.heading_rad);
  return {.turn = {c, -s, 0, s, c, 0, 0, 0, 1}, .shift = pose.position_m};
}

bool is_finite(const Rigid& motion) {
  const auto finite = [](double value) { return std::isfinite(value); };
  return std::ranges::all_of(motion.turn, finite) && std::ranges::all_of(motion.shift, finite);
}

MotionFinder::Transform rounded(const Rigid& motion) {
  MotionFinder::Transform out;
  for (std::size_t i = 0; i < 9; ++i) out.turn.at(i) = static_cast<float>(motion.turn.at(i));
  for (std::size_t i = 0; i < 3; ++i) out.shift_m.at(i) = static_cast<float>(motion.shift.at(i));
  return out;
}

bool same_pose(const ActorPose& one, const ActorPose& other) {
  return one.position_m == other.position_m && one.heading_rad == other.heading_rad;
}

/// A camera in single precision.
struct Lens {
  float fx, fy, k1, k2, k3, p1, p2;

  Lens(const CameraIntrinsics& camera, const LensDistortion& lens)
      : fx(static_cast<float>(camera.fx_px)),
        fy(static_cast<float>(camera.fy_px)),
        k1(static_cast<float>(lens.k1)),
        k2(static_cast<float>(lens.k2)),
        k3(static_cast<float>(lens.k3)),
        p1(static_cast<float>(lens.p1)),
        p2(static_cast<float>(lens.p2)) {}
};

/// Position in the lens's picture of a direction, relative to the principal point [px]; distort() in single precision.
VELDT_INLINE void shown_at(const Lens& lens, float x, float y, float& right_px, float& down_px) {
  const float r2 = x * x + y * y;
  const float radial = 1 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
  right_px = lens.fx * (x * radial + 2 * lens.p1 * x * y + lens.p2 * (r2 + 2 * x * x));
  down_px = lens.fy * (y * radial + lens.p1 * (r2 + 2 * y * y) + 2 * lens.p2 * x * y);
}

/// 0 for NaN and points behind the other camera.
VELDT_INLINE void motion_at(const Lens& lens, const MotionFinder::Transform& to, float scale, float ray_x,
                            float ray_y, float depth_m, float& x_px, float& y_px) {
  const float depth = depth_m < kSkyFromM ? depth_m : kSkyFromM;
  const float x = depth * ray_x;
  const float y = depth * ray_y;
  const float other_x = (to.turn[0] * x + to.turn[1] * y + to.turn[2] * depth) + to.shift_m[0];
  const float other_y = (to.turn[3] * x + to.turn[4] * y + to.turn[5] * depth) + to.shift_m[1];
  const float other_z = (to.turn[6] * x + to.turn[7] * y + to.turn[8] * depth) + to.shift_m[2];
  float now_right = 0;
  float now_down = 0;
  float other_right = 0;
  float other_down = 0;
  shown_at(lens, ray_x, ray_y, now_right, now_down);
  shown_at(lens, other_x / other_z, other_y / other_z, other_right, other_down);
  const float right = scale * (now_right - other_right);
  const float down = scale * (now_down - other_down);
  const float most = std::abs(right) > std::abs(down) ? std::abs(right) : std::abs(down);
  const float usable =
      (depth > 0 ? 1.0F : 0.0F) * (other_z > 0 ? 1.0F : 0.0F) * (most <= kMostMotionPx ? 1.0F : 0.0F);
  const float least = most >= 0 ? usable : 0;  // NaN compares false
  x_px = least > 0 ? right : 0.0F;
  y_px = least > 0 ? down : 0.0F;
}

VELDT_CLONES void row_motion(const Lens& lens, const MotionFinder::Transform& to, float scale,
                             const float* __restrict ray_x, const float* __restrict ray_y,
                             const float* __restrict depth_m, std::size_t count, float* __restrict x_px,
                             float* __restrict y_px) {
  const Lens copied = lens;
  const MotionFinder::Transform transform = to;
  for (std::size_t i = 0; i < count; ++i)
    motion_at(copied, transform, scale, ray_x[i], ray_y[i], depth_m[i], x_px[i], y_px[i]);
}

/// Pixel of the passes that each pixel of the camera shows; empty if they are the same.
std::vector<std::int32_t> shown_pixels(const Manifest& manifest, const CameraIntrinsics& passes,
                                       const CameraRays& rays, const LensDistortion& lens) {
  if (manifest.overscan_px == 0 && lens == manifest.lens) return {};
  std::vector<std::int32_t> shown;
  shown.reserve(rays.x().size());
  for (std::size_t i = 0; i < rays.x().size(); ++i) {
    const PicturePoint picture_point =
        project(passes, manifest.lens,
                {static_cast<double>(rays.x().pixels()[i]), static_cast<double>(rays.y().pixels()[i])});
    const auto inside = [](double px, int size) {
      return px > 0 ? std::min(static_cast<int>(std::min(px, 1e6)), size - 1) : 0;  // NaN compares false
    };
    shown.push_back(inside(picture_point.v_px, passes.height_px) * passes.width_px +
                    inside(picture_point.u_px, passes.width_px));
  }
  return shown;
}

/// Depth and index of adaptively sampled passes at the samples that expanded planes would be read at.
Passes read_at_samples(const Passes& passes) {
  Passes out;
  out.depth_m = passes.depth_m;
  out.object_index = passes.object_index;
  const FineSamples& fine = passes.fine;
  const auto side = static_cast<std::size_t>(fine.factor);
  for (int y = 0; y < out.depth_m.height_px(); ++y) {
    const std::size_t first = fine.row_begin[static_cast<std::size_t>(y)];
    const std::size_t line = fine.line_begin(y, fine.factor / 2);
    for (std::size_t i = 0; i < fine.pixels_in(y); ++i) {
      const int x = fine.x_px[first + i];
      const std::size_t sample = line + i * side + side / 2;
      out.depth_m.at(x, y) = fine.depth_m[sample];
      out.object_index.at(x, y) = fine.object_index[sample];
    }
  }
  return out;
}

}  // namespace

MotionFinder::MotionFinder(const Manifest& manifest, const LensDistortion& lens)
    : camera_(manifest.camera),
      lens_(lens),
      frame_rate_hz_(manifest.frame_rate_hz),
      passes_(pixels_camera(manifest)),
      rays_(manifest.camera, lens),
      shown_(shown_pixels(manifest, passes_, rays_, lens)) {
  const std::vector<ManifestFrame>& frames = manifest.frames;
  if (frames.size() == 1) steps_.emplace_back();
  if (frames.size() < 2) return;
  steps_.push_back(step_of(frames[0], frames[1], true));
  for (std::size_t frame = 1; frame < frames.size(); ++frame)
    steps_.push_back(step_of(frames[frame], frames[frame - 1], false));
}

MotionFinder::Step MotionFinder::step_of(const ManifestFrame& now, const ManifestFrame& other,
                                         bool other_is_next) const {
  Step step;
  if (!now.camera_to_world || !other.camera_to_world) return step;
  const Rigid from_camera = rigid_of(*now.camera_to_world);
  const Rigid to_other = inverse(rigid_of(*other.camera_to_world));
  if (!is_finite(from_camera) || !is_finite(to_other)) return step;
  const double intervals = std::abs(now.time_s - other.time_s) * frame_rate_hz_;
  step.scale = static_cast<float>((other_is_next ? -1 : 1) / (intervals > 1 ? intervals : 1));
  step.camera_moves = *now.camera_to_world != *other.camera_to_world;
  step.camera = rounded(then(from_camera, to_other));
  for (const ActorPose& pose : now.actors) {
    const auto before = std::ranges::find(other.actors, pose.index, &ActorPose::index);
    if (before == other.actors.end() || same_pose(pose, *before)) continue;
    const Rigid moved = then(then(from_camera, then(inverse(rigid_of(pose)), rigid_of(*before))), to_other);
    if (is_finite(moved)) step.actors.push_back({.index = pose.index, .transform = rounded(moved)});
  }
  step.moves = step.camera_moves || !step.actors.empty();
  return step;
}

std::size_t MotionFinder::source(const Plane<float>& depth_m, int x, int y) const {
  const int factor = depth_m.width_px() / passes_.width_px;
  if (!shown_.empty()) {
    const std::int32_t pixel = shown_[static_cast<std::size_t>(y * camera_.width_px + x)];
    x = pixel % passes_.width_px;
    y = pixel / passes_.width_px;
  }
  return static_cast<std::size_t>(y * factor + factor / 2) * static_cast<std::size_t>(depth_m.width_px()) +
         static_cast<std::size_t>(x * factor + factor / 2);
}

void MotionFinder::find(const Passes& passes, int frame, ImageMotion& out) const {
  find(passes, steps_[static_cast<std::size_t>(frame)], out);
}

void MotionFinder::find(const Passes& passes, const ManifestFrame& before, const ManifestFrame& now,
                        ImageMotion& out) const {
  find(passes, step_of(now, before, false), out);
}

void MotionFinder::find(const Passes& passes, const Step& step, ImageMotion& out) const {
  if (!step.moves || passes.depth_m.empty()) {
    out = {};
    return;
  }
  if (passes.fine.factor > 1 && !passes.fine.depth_m.empty()) {
    find(read_at_samples(passes), step, out);
    return;
  }
  out.x_px.resize(camera_.width_px, camera_.height_px);
  out.y_px.resize(camera_.width_px, camera_.height_px);
  parallel_rows(camera_.height_px, kMotionRowsPerChunk,
                [&](int y) { find_row(passes.depth_m, step, y, out); });
  if (!step.actors.empty()) move_actors(passes, step, out);
}

void MotionFinder::find_row(const Plane<float>& depth_m, const Step& step, int y, ImageMotion& out) const {
  const auto count = static_cast<std::size_t>(camera_.width_px);
  if (!step.camera_moves) {
    std::ranges::fill(out.x_px.row(y), 0.0F);
    std::ranges::fill(out.y_px.row(y), 0.0F);
    return;
  }
  const float* depths = nullptr;
  std::vector<float> copied;
  if (shown_.empty() && depth_m.width_px() == camera_.width_px) {
    depths = depth_m.row(y).data();
  } else {
    copied.resize(count);
    for (std::size_t x = 0; x < count; ++x)
      copied[x] = depth_m.pixels()[source(depth_m, static_cast<int>(x), y)];
    depths = copied.data();
  }
  row_motion(Lens(camera_, lens_), step.camera, step.scale, rays_.x().row(y).data(), rays_.y().row(y).data(),
             depths, count, out.x_px.row(y).data(), out.y_px.row(y).data());
}

/// An actor's pixels, then the trails behind them, in the order of the picture: the last actor wins.
void MotionFinder::move_actors(const Passes& passes, const Step& step, ImageMotion& out) const {
  std::vector<std::uint16_t> number_of(65536, 0);  // 1 + index among the step's actors
  for (std::size_t i = 0; i < step.actors.size(); ++i)
    number_of[step.actors[i].index] = static_cast<std::uint16_t>(i + 1);
  struct Seen {
    int x, y;
    float x_px, y_px;
  };
  std::vector<Seen> apart;
  const Lens lens(camera_, lens_);
  const auto index_at = [&](int x, int y) {
    return passes.object_index.pixels()[source(passes.depth_m, x, y)];
  };
  const bool is_direct = shown_.empty() && passes.depth_m.width_px() == camera_.width_px;
  for (int y = 0; y < camera_.height_px; ++y) {
    const std::uint16_t* line = is_direct ? passes.object_index.row(y).data() : nullptr;
    for (int x = 0; x < camera_.width_px; ++x) {
      const std::uint16_t number = number_of[line != nullptr ? line[x] : index_at(x, y)];
      if (number == 0) continue;
      float x_px = 0;
      float y_px = 0;
      motion_at(lens, step.actors[number - 1U].transform, step.scale, rays_.x().at(x, y), rays_.y().at(x, y),
                passes.depth_m.pixels()[source(passes.depth_m, x, y)], x_px, y_px);
      const float other = std::max(std::abs(x_px - out.x_px.at(x, y)), std::abs(y_px - out.y_px.at(x, y)));
      if (other >= kApartPx) apart.push_back({x, y, x_px, y_px});
      out.x_px.at(x, y) = x_px;
      out.y_px.at(x, y) = y_px;
    }
  }
  for (const Seen& seen : apart) {
    const float length = std::max(std::abs(seen.x_px), std::abs(seen.y_px));
    const int steps = std::min(static_cast<int>(std::ceil(length)), kLongestTrailPx);
    const float depth = passes.depth_m.pixels()[source(passes.depth_m, seen.x, seen.y)];
    for (int k = 1; k <= steps; ++k) {
      const float share = static_cast<float>(k) / std::max(length, 1.0F);
      const auto x = static_cast<int>(std::lround(static_cast<float>(seen.x) - share * seen.x_px));
      const auto y = static_cast<int>(std::lround(static_cast<float>(seen.y) - share * seen.y_px));
      if (x < 0 || y < 0 || x >= camera_.width_px || y >= camera_.height_px) break;
      if (number_of[index_at(x, y)] != 0) break;
      if (passes.depth_m.pixels()[source(passes.depth_m, x, y)] < depth) continue;
      out.x_px.at(x, y) = seen.x_px;
      out.y_px.at(x, y) = seen.y_px;
    }
  }
}

}  // namespace thermal
