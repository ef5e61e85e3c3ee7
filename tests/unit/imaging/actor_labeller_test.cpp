#include "imaging/actor_labeller.h"

#include <cmath>

#include "base/error.h"
#include "support/catch.h"
#include "support/drawn.h"
#include "support/message_of.h"

namespace actor_labeller_test {

using namespace thermal;

namespace {

using IndexPlane = Plane<std::uint16_t>;

ManifestObject object(std::uint16_t index, ObjectClass object_class) {
  ManifestObject result;
  result.index = index;
  result.object_class = object_class;
  return result;
}

/// Ground 1, a tree 2, actors 8, 3 and 9. The camera has the size of `plane`, with a tangent of 1 at 10 px.
Manifest manifest_for(const IndexPlane& plane, int supersample = 1) {
  Manifest result;
  result.supersample = supersample;
  result.camera = {.width_px = plane.width_px() / supersample,
                   .height_px = plane.height_px() / supersample,
                   .fx_px = 10,
                   .fy_px = 10,
                   .cx_px = plane.width_px() / 2.0 / supersample,
                   .cy_px = plane.height_px() / 2.0 / supersample};
  result.objects = {object(1, ObjectClass::ground), object(2, ObjectClass::plant),
                    object(8, ObjectClass::actor), object(3, ObjectClass::actor),
                    object(9, ObjectClass::actor)};
  return result;
}

Passes passes_of(const IndexPlane& all, const IndexPlane& alone = {}) {
  Passes passes;
  passes.object_index = all;
  passes.actor_index = alone;
  return passes;
}

std::vector<Instance> labels_of(const Manifest& manifest, const Passes& passes,
                                const ManifestFrame& frame = {}) {
  return ActorLabeller(manifest, {}, nullptr).label(passes, survey_indices(passes.object_index), frame);
}

std::vector<Instance> labels_of(const IndexPlane& all, const IndexPlane& alone = {}) {
  return labels_of(manifest_for(all), passes_of(all, alone));
}

}  // namespace

TEST_CASE("An animal behind a trunk is one instance, and its visibility is the fraction left") {
  const std::vector<Instance> labels = labels_of(drawn({"111211",  //
                                                        "133231",  //
                                                        "133231",  //
                                                        "111211"}),
                                                 drawn({"......",  //
                                                        ".3333.",  //
                                                        ".3333.",  //
                                                        "......"}));
  REQUIRE(labels.size() == 1);
  CHECK(labels[0].box == PixelBox{1, 1, 4, 2});
  CHECK(labels[0].area_px == 6);
  CHECK(labels[0].mask == RunLengths{5, 2, 2, 2, 6, 2, 5});
  CHECK(labels[0].visibility == 0.75);
  CHECK(labels[0].whole_box == LabelBox{1, 1, 4, 2});
  CHECK(labels[0].truncated_fraction == 0);
  CHECK_FALSE(labels[0].covered_px);
}

TEST_CASE("The whole box includes hidden parts") {
  const std::vector<Instance> labels = labels_of(drawn({"......", ".32222", "......"}),  //
                                                 drawn({"......", ".3333.", "......"}));
  CHECK(labels.at(0).box == PixelBox{1, 1, 1, 1});
  CHECK(labels.at(0).whole_box == LabelBox{1, 1, 4, 1});
  CHECK(labels.at(0).visibility == 0.25);
  CHECK_FALSE(labels.at(0).truncated);
}

TEST_CASE("A completely hidden actor has no label; occlusion among actors does not depend on plants") {
  const std::vector<Instance> labels = labels_of(drawn({"22.89.", "22.89."}), drawn({"33.89.", "33.89."}));
  REQUIRE(labels.size() == 2);
  CHECK(labels[0].index == 8);
  CHECK(labels[0].visibility == 1);
  CHECK(labels[1].index == 9);
  CHECK(labels[1].visibility == 1);
}

TEST_CASE("Visibility is never above 1, and unknown if the layer lacks the actor") {
  const std::vector<Instance> labels = labels_of(drawn({"....", ".33.", ".88.", "...."}),  //
                                                 drawn({"....", ".3..", "....", "...."}));
  REQUIRE(labels.size() == 2);
  CHECK(labels[0].visibility == 1);
  CHECK(labels[0].whole_box == LabelBox{1, 1, 2, 1});
  CHECK_FALSE(labels[1].visibility);
}

TEST_CASE("A frame without actor layer has labels without visibility") {
  const std::vector<Instance> labels = labels_of(drawn({"....", ".33.", "...."}));
  REQUIRE(labels.size() == 1);
  CHECK_FALSE(labels[0].visibility);
  CHECK(labels[0].whole_box == LabelBox{1, 1, 2, 1});
  CHECK(labels[0].truncated_fraction == 0);
}

TEST_CASE(
    "An index in the actor layer that is not an actor's is an error with its place and the known ones") {
  CHECK(message_of<DataError>([] {
          (void)labels_of(drawn({"133", "122"}), drawn({".33", ".22"}));
        }) ==
        "actor layer's object index at pixel (1, 1) = 2 (2 pixels); expected an index of the manifest's "
        "actors: "
        "0, 3, 8, 9");
}

namespace {

/// Level at the origin, looking along +x with +z up: right is -y, down is -z.
const std::array<double, 16> kLevel = {0, 0, 1, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 1};

/// The manifest with a cube of 2 m for actor 3, and the frame in which its centre is at (10, y_m, z_m).
Manifest with_cube(Manifest manifest) {
  manifest.objects[3].bounds_m = {{{-1, -1, 0}, {1, 1, 2}}};
  return manifest;
}

ManifestFrame cube_at(double y_m, double z_m) {
  ManifestFrame frame;
  frame.camera_to_world = kLevel;
  frame.actors = {{.index = 8, .position_m = {50, 0, 0}, .heading_rad = 0},  // out of sight, without bounds
                  {.index = 3, .position_m = {10, y_m, z_m - 1}, .heading_rad = 0}};
  return frame;
}

}  // namespace

TEST_CASE("An actor cut by a corner of the frame extends as far as its box in the world") {
  const IndexPlane plane = drawn({"33..",  //
                                  "3...",  //
                                  "...."});
  const Manifest manifest = with_cube(manifest_for(plane));
  // Left and above: y and z are positive. The near face, at 9 m, is 10 / 9 px per metre. The camera's centre is (2,
  // 1.5).
  const std::vector<Instance> labels = labels_of(manifest, passes_of(plane), cube_at(2.4, 1.7));
  REQUIRE(labels.size() == 1);
  CHECK(labels[0].truncated);
  const double left_px = 2 - 3.4 / 0.9;
  const double top_px = 1.5 - 2.7 / 0.9;
  REQUIRE(labels[0].whole_box);
  CHECK_THAT(labels[0].whole_box->x_px, WithinAbs(left_px, 1e-12));
  CHECK_THAT(labels[0].whole_box->y_px, WithinAbs(top_px, 1e-12));
  CHECK_THAT(labels[0].whole_box->width_px, WithinAbs(2 - left_px, 1e-12));  // inside, its pixels decide
  CHECK_THAT(labels[0].whole_box->height_px, WithinAbs(2 - top_px, 1e-12));
  CHECK_THAT(labels[0].truncated_fraction.value(),
             WithinAbs(1 - 2 * 2 / ((2 - left_px) * (2 - top_px)), 1e-12));
  CHECK_THAT(labels[0].range_m.value(), WithinAbs(std::hypot(10, 2.4, 1.7), 1e-12));
}

TEST_CASE("The same holds at the right and lower borders") {
  const IndexPlane plane = drawn({"....", "..33", "..33"});
  const std::vector<Instance> labels =
      labels_of(with_cube(manifest_for(plane)), passes_of(plane), cube_at(-2.4, -1.7));
  REQUIRE(labels.at(0).whole_box);
  CHECK(labels[0].whole_box->x_px == 2);
  CHECK(labels[0].whole_box->y_px == 1);
  CHECK_THAT(labels[0].whole_box->width_px, WithinAbs(3.4 / 0.9, 1e-12));
  CHECK_THAT(labels[0].whole_box->height_px, WithinAbs(0.5 + 2.7 / 0.9, 1e-12));
}

TEST_CASE("The excess of the box in the world on one side is subtracted on the other") {
  Plane<std::uint16_t> plane(8, 3);
  plane.at(0, 1) = 3;
  // The centre is at x = 4. The box reaches from 4 - 4.4 / 0.9 to 4 - 2.4 / 1.1 = 1.82, the pixels end at 1.
  const Instance wide = labels_of(with_cube(manifest_for(plane)), passes_of(plane), cube_at(3.4, 0)).at(0);
  CHECK_THAT(wide.whole_box.value().x_px, WithinAbs(4 - 4.4 / 0.9 + (4 - 2.4 / 1.1 - 1), 1e-12));
  CHECK(wide.whole_box.value().y_px == 1);
  Plane<std::uint16_t> right(8, 3);
  right.at(7, 1) = 3;  // likewise at the opposite border, mirrored
  const Instance mirrored =
      labels_of(with_cube(manifest_for(right)), passes_of(right), cube_at(-3.4, 0)).at(0);
  CHECK_THAT(mirrored.whole_box.value().width_px, WithinAbs(1 - wide.whole_box->x_px, 1e-12));
  plane.at(1, 1) = 3;  // they end at 2: it is not too wide there
  const Instance narrow = labels_of(with_cube(manifest_for(plane)), passes_of(plane), cube_at(3.4, 0)).at(0);
  CHECK_THAT(narrow.whole_box.value().x_px, WithinAbs(4 - 4.4 / 0.9, 1e-12));
}

TEST_CASE("Within the frame the box in the world changes nothing") {
  const IndexPlane plane = drawn({"....", ".3..", "...."});
  const std::vector<Instance> labels =
      labels_of(with_cube(manifest_for(plane)), passes_of(plane), cube_at(0, 0));
  CHECK(labels.at(0).whole_box == LabelBox{1, 1, 1, 1});
  CHECK(labels.at(0).truncated_fraction == 0);
  CHECK(labels.at(0).range_m == 10);
}

TEST_CASE("One whose hidden part touches the border is cut there") {
  const IndexPlane all = drawn({"....", "23..", "...."});
  const IndexPlane alone = drawn({"....", "33..", "...."});
  const std::vector<Instance> labels =
      labels_of(with_cube(manifest_for(all)), passes_of(all, alone), cube_at(2.4, 0));
  CHECK(labels.at(0).truncated);
  CHECK_THAT(labels.at(0).whole_box.value().x_px, WithinAbs(2 - 3.4 / 0.9, 1e-12));
  CHECK(labels_of(all).at(0).truncated == false);
}

TEST_CASE("The truncated fraction is unknown without poses, and never negative") {
  const IndexPlane plane = drawn({"3...", "....", "...."});
  const Instance unknown = labels_of(plane).at(0);
  CHECK(unknown.truncated);
  CHECK_FALSE(unknown.truncated_fraction);
  CHECK_FALSE(unknown.whole_box);
  // The box in the world ends within the frame: nothing is known to be outside.
  const Instance inside = labels_of(with_cube(manifest_for(plane)), passes_of(plane), cube_at(-1, -1)).at(0);
  CHECK(inside.truncated);
  CHECK(inside.truncated_fraction == 0);
  // Behind the camera, whatever the picture shows.
  ManifestFrame behind = cube_at(0, 0);
  behind.actors[1].position_m[0] = -10;
  const Instance odd = labels_of(with_cube(manifest_for(plane)), passes_of(plane), behind).at(0);
  CHECK_FALSE(odd.truncated_fraction);
  CHECK_FALSE(odd.whole_box);
}

TEST_CASE("Without poses, range is the mean over the pixels, along their rays") {
  const IndexPlane plane = drawn({"....", ".33.", "...."});  // 0.5 px left and right of the middle
  Passes passes = passes_of(plane);
  CHECK_FALSE(labels_of(manifest_for(plane), passes).at(0).range_m);
  passes.depth_m = Plane<float>(4, 3, 1e10F);
  passes.depth_m.at(1, 1) = 20;
  passes.depth_m.at(2, 1) = 40;
  CHECK_THAT(labels_of(manifest_for(plane), passes).at(0).range_m.value(),
             WithinAbs(30 * std::hypot(0.05, 1), 1e-12));
  passes.depth_m.at(2, 1) = std::numeric_limits<float>::quiet_NaN();
  CHECK_THAT(labels_of(manifest_for(plane), passes).at(0).range_m.value(),
             WithinAbs(20 * std::hypot(0.05, 1), 1e-12));
  passes.depth_m.at(1, 1) = std::numeric_limits<float>::infinity();
  CHECK_FALSE(labels_of(manifest_for(plane), passes).at(0).range_m);
}

TEST_CASE("Depths that no distance can have do not count") {
  const IndexPlane plane = drawn({"....", ".33.", "...."});
  Passes passes = passes_of(plane);
  passes.depth_m = Plane<float>(4, 3, 20);
  for (const float value : {-9999.0F, 0.0F, 1e10F, 3.4e38F}) {
    passes.depth_m.at(2, 1) = value;
    CHECK_THAT(labels_of(manifest_for(plane), passes).at(0).range_m.value(),
               WithinAbs(20 * std::hypot(0.05, 1), 1e-12));
  }
}

TEST_CASE("Depth is wanted unless every frame places the camera and all actors, whatever the terms") {
  const IndexPlane plane = drawn({"....", ".33.", "...."});
  Manifest manifest = manifest_for(plane);
  const auto wants_depth = [&manifest] { return ActorLabeller(manifest, {}, nullptr).wants_depth(); };
  manifest.frames = {cube_at(0, 0), cube_at(1, 0)};
  for (ManifestObject& object : manifest.objects) object.bounds_m = {{{-1, -1, 0}, {1, 1, 2}}};
  for (ManifestFrame& frame : manifest.frames) {
    frame.actors.clear();
    for (const ManifestObject& object : manifest.objects) frame.actors.push_back({.index = object.index});
  }
  CHECK_FALSE(wants_depth());
  manifest.frames[1].actors.pop_back();
  CHECK(wants_depth());
  manifest.frames[1] = manifest.frames[0];
  CHECK_FALSE(wants_depth());
  manifest.frames[1].camera_to_world.reset();
  CHECK(wants_depth());
  manifest.frames[1] = manifest.frames[0];
  manifest.objects.back().bounds_m.reset();
  CHECK(wants_depth());
}

TEST_CASE(
    "In finer passes a label has the pixels that are at least half covered, and counts all covered ones") {
  const IndexPlane all = drawn({"....33",  //
                                ".33333",  //
                                "22333.",  //
                                "......"});
  const IndexPlane alone = drawn({"....33",  //
                                  "333333",  //
                                  "33333.",  //
                                  "......"});
  const Instance label = labels_of(manifest_for(all, 2), passes_of(all, alone)).at(0);
  // Of 3 x 2 pixels, upper row: 1, 2 and 4 sub-pixels; lower row: 0, 2 and 1.
  CHECK(label.box == PixelBox{1, 0, 2, 2});
  CHECK(label.area_px == 3);
  CHECK(label.covered_px == 2.5);
  CHECK_THAT(label.visibility.value(), WithinAbs(10.0 / 13, 1e-12));
  // Alone: 2, 2, 4 and 2, 2, 1.
  CHECK(labels_of(manifest_for(all, 2), passes_of(alone, alone)).at(0).box == PixelBox{0, 0, 3, 2});
}

TEST_CASE("A target smaller than a pixel is labelled if it covers half of one") {
  IndexPlane fine(8, 4);
  fine.at(5, 1) = fine.at(5, 2) = fine.at(6, 1) = fine.at(6, 2) = 3;
  fine.at(4, 1) = fine.at(7, 1) = fine.at(4, 2) = 3;
  CHECK(labels_of(manifest_for(fine, 4), passes_of(fine)).empty());  // 7 of 16
  fine.at(7, 2) = 3;
  const Instance label = labels_of(manifest_for(fine, 4), passes_of(fine, fine)).at(0);
  CHECK(label.box == PixelBox{1, 0, 1, 1});
  CHECK(label.area_px == 1);
  CHECK(label.covered_px == 0.5);
  CHECK(label.visibility == 1);
}

TEST_CASE("The overscan is not part of the picture") {
  const IndexPlane all = drawn({"......", ".2233.", "......"});
  const IndexPlane alone = drawn({"......", "333333", "......"});
  Manifest manifest = manifest_for(all);
  manifest.camera = {.width_px = 4, .height_px = 1, .fx_px = 10, .fy_px = 10, .cx_px = 2, .cy_px = 0.5};
  manifest.overscan_px = 1;
  const auto map = std::make_shared<const ResampleMap>(manifest.camera, 1, LensDistortion());
  const Passes passes = passes_of(all, alone);
  const std::vector<IndexUse> uses = survey_indices(all);
  const Instance label = ActorLabeller(manifest, {}, map).label(passes, uses, {}).at(0);
  CHECK(label.box == PixelBox{2, 0, 2, 1});
  CHECK(label.visibility == 0.5);
  CHECK(label.truncated);
}

TEST_CASE("Finer passes also count only pixels in the picture") {
  IndexPlane all(12, 6);  // 6 x 3 px of 2 x 2, of which the picture is the central 4 x 1
  IndexPlane alone(12, 6);
  for (int y = 2; y < 4; ++y) {
    for (int x = 0; x < 12; ++x) alone.at(x, y) = 3;
    for (int x = 5; x < 12; ++x) all.at(x, y) = 3;
  }
  Manifest manifest = manifest_for(all);
  manifest.supersample = 2;
  manifest.overscan_px = 1;
  manifest.camera = {.width_px = 4, .height_px = 1, .fx_px = 10, .fy_px = 10, .cx_px = 2, .cy_px = 0.5};
  const auto map = std::make_shared<const ResampleMap>(manifest.camera, 1, LensDistortion());
  const Instance label =
      ActorLabeller(manifest, {}, map).label(passes_of(all, alone), survey_indices(all), {}).at(0);
  CHECK(label.covered_px == 2.5);  // columns 5 to 9 of 2 to 9
  CHECK(label.visibility == 10.0 / 16);
  CHECK(label.area_px == 3);  // column 2 of the picture's is half covered
}

}  // namespace actor_labeller_test
