#include <cmath>

#include "scene/baked_scene.h"
#include "support/catch.h"

namespace baked_moment_test {

using namespace thermal;

namespace {

constexpr Transform<float> bone_at(float x_m) { return {1, 0, 0, x_m, 0, 1, 0, 0, 0, 0, 1, 0}; }

/// Two actors, of one bone and of two, in three frames: the first is posed in all, the second in the last two.
struct Walk {
  BakedScene scene;
  std::vector<double> time_s = {10, 10.5, 11};
  std::vector<std::array<double, 16>> cameras = std::vector<std::array<double, 16>>(3);
  std::vector<std::array<double, 3>> positions_m = {{0, 0, 0}, {1, 0, 0}, {2, 4, 0},
                                                    {5, 5, 5}, {5, 5, 5}, {5, 7, 5}};
  std::vector<double> headings_rad = {3, -3, -2.8, 0, 0, 1};
  std::vector<std::uint8_t> posed = {1, 1, 1, 0, 1, 1};
  std::vector<Transform<float>> bones = {bone_at(0),  bone_at(1),  bone_at(2), bone_at(10),
                                         bone_at(20), bone_at(12), bone_at(24)};
  BakedTrack track;

  Walk() {
    scene.actors.resize(2);
    scene.actors[0].bones.resize(1);
    scene.actors[1].bones.resize(2);
    for (std::size_t k = 0; k < 3; ++k) cameras[k][3] = static_cast<double>(k);
    track.frames = 3;
    track.time_s = time_s;
    track.camera_to_world = cameras;
    track.actor_position_m = positions_m;
    track.actor_heading_rad = headings_rad;
    track.posed = posed;
    track.bones = bones;
  }
};

}  // namespace

TEST_CASE("A frame's moment is the frame as it is baked") {
  const Walk walk;
  const TrackMoments moments(walk.scene, walk.track);
  const BakedMoment first = moments.at_frame(0);
  CHECK(first.bones == std::vector{bone_at(0)});
  CHECK(first.posed == std::vector<std::uint8_t>{1, 0});
  const BakedMoment last = moments.at_frame(2);
  CHECK(last.bones == std::vector{bone_at(2), bone_at(12), bone_at(24)});
  CHECK(last.actor_position_m[1] == std::array<double, 3>{5, 7, 5});
  CHECK(last.camera_to_world[3] == 2);
  for (std::size_t k = 0; k < 3; ++k)
    CHECK(moments.at_time(walk.time_s[k]).bones == moments.at_frame(k).bones);
}

TEST_CASE("Between frames places and bones move along straight lines") {
  const Walk walk;
  const BakedMoment now = TrackMoments(walk.scene, walk.track).at_time(10.625);
  CHECK(now.actor_position_m[0] == std::array<double, 3>{1.25, 1, 0});
  CHECK(now.bones == std::vector{bone_at(1.25F), bone_at(10.5F), bone_at(21)});
  CHECK(now.camera_to_world[3] == 1);
}

TEST_CASE("Headings turn the shorter way") {
  const Walk walk;
  const TrackMoments moments(walk.scene, walk.track);
  // From 3 to -3 is 0.283 rad over pi, and not 6 back.
  CHECK_THAT(moments.at_time(10.25).actor_heading_rad[0], WithinAbs(M_PI, 1e-12));
  CHECK_THAT(moments.at_time(10.75).actor_heading_rad[0], WithinAbs(-2.9, 1e-12));
}

TEST_CASE("Who is unknown in one of two frames is in neither") {
  const Walk walk;
  const BakedMoment now = TrackMoments(walk.scene, walk.track).at_time(10.25);
  CHECK(now.posed == std::vector<std::uint8_t>{1, 0});
  CHECK(now.bones == std::vector{bone_at(0.5F)});
}

}  // namespace baked_moment_test
