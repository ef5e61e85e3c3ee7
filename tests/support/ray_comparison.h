#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "scene/passes.h"
#include "support/ray_truth.h"

/// Frames of the engine against the truth, pixel by pixel.
namespace ray_truth {

/// A triangle that a pixel may show, as seen by rays close to the pixel's.
struct Candidate {
  const Triangle* triangle = nullptr;
  bool certain = true;  ///< every ray hits it
  std::optional<Meeting> middle;
  Number nearest = std::numeric_limits<Number>::infinity();
  Number farthest = 0;
  Vector least{2, 2, 2};
  Vector most{-2, -2, -2};

  void add(const Meeting& meeting) {
    const Vector& n = meeting.normal;
    nearest = std::min(nearest, meeting.depth);
    farthest = std::max(farthest, meeting.depth);
    least = {std::min(least.x, n.x), std::min(least.y, n.y), std::min(least.z, n.z)};
    most = {std::max(most.x, n.x), std::max(most.y, n.y), std::max(most.z, n.z)};
  }
};

/// How far from a pixel's ray others are tried, in units of the focal length. Embree aims in single precision: a ray
/// is off by 1e-7 of its length, and by as much of the size of coordinates, after a dozen roundings of 6e-8 each.
inline constexpr Number kAside = 2e-6L;
inline constexpr int kRays = 9;  ///< a pixel's own in the middle

/// Whether none of the rays around one hits a triangle.
inline bool is_far(const Triangle& triangle, const Vector& d) {
  int signs = 0;
  for (const Vector& edge : triangle.edge) {
    const Number side = dot(d, edge);
    const Number margin = 2 * kAside * (std::abs(edge.x) + std::abs(edge.y) + std::abs(edge.z));
    if (std::abs(side) > margin) signs |= side > 0 ? 1 : 2;
  }
  return signs == 3;
}

/// What a pixel may show.
struct Expected {
  std::vector<Candidate> candidates;
  bool may_be_sky = false;

  [[nodiscard]] bool is_uncertain() const {
    if (candidates.empty()) return false;
    const Triangle& first = *candidates.front().triangle;
    return may_be_sky || std::ranges::any_of(candidates, [&first](const Candidate& one) {
             return one.triangle->object != first.object || one.triangle->material != first.material;
           });
  }
};

/// The triangles that one of the rays around a pixel's hits, and nothing hides from all of them.
inline Expected expected(const std::vector<Triangle>& triangles, const Axes& axes, const Ray& ray,
                         bool actors_alone) {
  Expected all;
  std::array<Number, kRays> first;
  first.fill(std::numeric_limits<Number>::infinity());
  const Vector d = direction(axes, ray);
  for (const Triangle& triangle : triangles) {
    if ((actors_alone && !triangle.actor) || is_far(triangle, d)) continue;
    Candidate candidate{.triangle = &triangle, .middle = {}};
    for (int k = 0; k < kRays; ++k) {
      const auto meeting = meet(triangle, axes, {ray.x + (k % 3 - 1) * kAside, ray.y + (k / 3 - 1) * kAside});
      if (k == kRays / 2) candidate.middle = meeting;
      candidate.certain &= meeting.has_value();
      if (!meeting) continue;
      candidate.add(*meeting);
      Number& nearest = first.at(static_cast<std::size_t>(k));
      nearest = std::min(nearest, meeting->depth);
    }
    if (candidate.farthest > 0) all.candidates.push_back(candidate);
  }
  const Number limit = *std::ranges::max_element(first);
  all.may_be_sky = std::isinf(limit);
  std::erase_if(all.candidates, [limit](const Candidate& one) { return one.nearest > limit * (1 + kAside); });
  return all;
}

inline constexpr Number kHalfUlp = 0x1p-24L;  ///< of a number of single precision near 1

inline bool is_between(float value, Number least, Number most, Number slack) {
  return value >= least - slack && value <= most + slack;
}

/// Whether a pixel shows a triangle: depth rounded once, normals after two more roundings, of those of points.
inline bool shows(const Candidate& seen, const thermal::Passes& passes, int x, int y) {
  constexpr Number kDepthSlack = 1.001L * kHalfUlp;
  constexpr Number kNormalSlack = 8 * kHalfUlp;
  Candidate exact{.triangle = seen.triangle, .middle = {}};
  if (seen.certain) exact.add(*seen.middle);
  const Candidate& range = seen.certain ? exact : seen;
  const float depth = passes.depth_m.at(x, y);
  return passes.object_index.at(x, y) == seen.triangle->object &&
         passes.material_index.at(x, y) == seen.triangle->material &&
         is_between(depth, range.nearest, range.farthest, kDepthSlack * depth) &&
         is_between(passes.normal[0].at(x, y), range.least.x, range.most.x, kNormalSlack) &&
         is_between(passes.normal[1].at(x, y), range.least.y, range.most.y, kNormalSlack) &&
         is_between(passes.normal[2].at(x, y), range.least.z, range.most.z, kNormalSlack);
}

inline bool is_sky(const thermal::Passes& passes, int x, int y) {
  return passes.object_index.at(x, y) == 0 && passes.material_index.at(x, y) == 0 &&
         passes.depth_m.at(x, y) == 1e10F &&
         std::ranges::all_of(passes.normal, [x, y](const auto& axis) { return axis.at(x, y) == 0; });
}

inline bool is_right(const Expected& wanted, const thermal::Passes& passes, int x, int y) {
  if (is_sky(passes, x, y)) return wanted.may_be_sky;
  return std::ranges::any_of(wanted.candidates,
                             [&](const Candidate& one) { return shows(one, passes, x, y); });
}

inline bool is_right_actor(const Expected& wanted, std::uint16_t actor) {
  if (actor == 0) return wanted.may_be_sky;
  return std::ranges::any_of(wanted.candidates,
                             [actor](const Candidate& one) { return one.triangle->object == actor; });
}

inline std::string text_of(const Vector& v) {
  return fmt::format("({:.9g}, {:.9g}, {:.9g})", static_cast<double>(v.x), static_cast<double>(v.y),
                     static_cast<double>(v.z));
}

inline std::string fault_at(const Expected& wanted, const thermal::Passes& passes, int x, int y) {
  std::string text =
      fmt::format("({}, {}): object {}, material {}, depth {:.9g}, normal {}; expected", x, y,
                  passes.object_index.at(x, y), passes.material_index.at(x, y), passes.depth_m.at(x, y),
                  text_of({passes.normal[0].at(x, y), passes.normal[1].at(x, y), passes.normal[2].at(x, y)}));
  if (wanted.may_be_sky) text += " the sky, or";
  for (const Candidate& one : wanted.candidates) {
    text += fmt::format(" object {}, material {}, depth {:.9g} to {:.9g}, normal {} to {};",
                        one.triangle->object, one.triangle->material, static_cast<double>(one.nearest),
                        static_cast<double>(one.farthest), text_of(one.least), text_of(one.most));
  }
  return text + "\n";
}

/// What the comparison of a frame found, in pixels.
struct Comparison {
  std::string faults;  ///< up to three
  int wrong = 0;
  int sky = 0;
  int actors = 0;
  int hidden = 0;     ///< actors in their layer that the picture does not show
  int uncertain = 0;  ///< may show more than one object or material, within the precision of Embree's rays
};

/// Compares a frame that was traced with all planes with the truth.
inline Comparison compare(const small_scene::Scenery& place, const small_scene::Clip& clip, std::size_t frame,
                          const thermal::CameraIntrinsics& camera, const thermal::Passes& passes,
                          const thermal::LensDistortion& lens = {}) {
  Comparison found;
  const std::vector<Triangle> triangles = triangles_in(place, clip, frame);
  const Axes axes(clip.camera_to_world[frame]);
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const Ray ray = ray_of(camera, lens, x, y);
      const Expected picture = expected(triangles, axes, ray, false);
      const std::uint16_t object = passes.object_index.at(x, y);
      const std::uint16_t actor = passes.actor_index.at(x, y);
      const bool right =
          is_right(picture, passes, x, y) && is_right_actor(expected(triangles, axes, ray, true), actor);
      if (!right && found.wrong++ < 3)
        found.faults += fmt::format("actor {} ", actor) + fault_at(picture, passes, x, y);
      found.sky += object == 0 ? 1 : 0;
      found.actors += object >= small_scene::kFirstActor ? 1 : 0;
      found.hidden += actor != 0 && object != actor ? 1 : 0;
      found.uncertain += picture.is_uncertain() ? 1 : 0;
    }
  }
  return found;
}

}  // namespace ray_truth
