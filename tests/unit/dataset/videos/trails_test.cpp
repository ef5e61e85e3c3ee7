#include "dataset/videos/trails.h"

#include <cmath>

#include "support/catch.h"

namespace trails_test {

using namespace thermal;

namespace {

/// A camera that looks straight down from 40 m and flies 5 m a frame to the north; x is right (east), y down (south).
FilmFrame flown(int index, double east_m, double north_m) {
  FilmFrame frame;
  frame.frame_index = index;
  frame.time_s = index;
  frame.agl_m = 40;
  frame.camera_to_world = {1, 0, 0, east_m, 0, -1, 0, north_m, 0, 0, -1, 40, 0, 0, 0, 1};
  return frame;
}

Label label_at(std::size_t image, double x_px, double y_px) {
  Label label;
  label.image = image;
  label.track_id = 7;
  label.box = {x_px - 2, y_px - 3, 4, 6};
  return label;
}

/// A target that stands still on the ground, seen in three frames; 30 px of focal length, so that 5 m are 3.75 px.
ClipFilm film_of_still_target() {
  ClipFilm film;
  film.camera = FilmCamera{.fx_px = 30, .fy_px = 30, .cx_px = 12, .cy_px = 8};
  film.labels.categories = {{1, "human"}};
  for (int k = 0; k < 3; ++k) {
    film.frames.push_back(flown(k, 0, 5.0 * k));
    film.labels.labels.push_back(label_at(static_cast<std::size_t>(k), 10, 4 + 3.75 * k));
    film.first_label.push_back(static_cast<std::size_t>(k));
  }
  film.first_label.push_back(3);
  return film;
}

// Pixel and metres go to and fro through OpenCV's undistortPoints and projectPoints, in double: some eps of 100.
constexpr double kRounding = 1e-9;

}  // namespace

TEST_CASE("The trail of a target that stands still is a point, however the camera moves") {
  const ClipFilm film = film_of_still_target();
  const std::vector<Trail> trails = Trails(film, 5).at(2);
  REQUIRE(trails.size() == 1);
  CHECK(trails[0].track == 7);
  REQUIRE(trails[0].points.size() == 3);
  for (const TrailPoint& point : trails[0].points) {
    CHECK_THAT(point.x_px, WithinAbs(10, kRounding));
    CHECK_THAT(point.y_px, WithinAbs(11.5, kRounding));
  }
  CHECK(trails[0].points[0].age_s == 2);
  CHECK(trails[0].points[2].age_s == 0);
}

TEST_CASE("A label's range places its target, also above the ground") {
  ClipFilm film = film_of_still_target();
  for (int k = 0; k < 3; ++k) {  // 20 m below the camera: 7.5 px a frame
    Label& label = film.labels.labels[static_cast<std::size_t>(k)];
    label.box = {12 - 2, 8 + 7.5 * k - 3, 4, 6};
    label.range_m = 20 * std::hypot(1, 7.5 * k / 30);
  }
  const std::vector<Trail> trails = Trails(film, 5).at(2);
  for (const TrailPoint& point : trails.at(0).points) {
    CHECK_THAT(point.x_px, WithinAbs(12, kRounding));
    CHECK_THAT(point.y_px, WithinAbs(23, kRounding));
  }
}

TEST_CASE("A trail goes through the lens both ways") {
  ClipFilm film = film_of_still_target();
  film.camera->distortion = {-0.2, 0.05, 0.001, -0.002, 0, 0, 0, 0};
  film.frames[1].camera_to_world = film.frames[0].camera_to_world;  // the camera has not moved
  const std::vector<TrailPoint> points = Trails(film, 5).at(1)[0].points;
  // undistortPoints ends its search at 0.01 px by default; this far off the axis it gets much nearer.
  CHECK_THAT(points[0].y_px, WithinAbs(4, 0.01));
  CHECK_THAT(points[1].y_px, WithinAbs(7.75, 0.01));
}

TEST_CASE("Without poses points stay where they were in the picture") {
  ClipFilm film = film_of_still_target();
  for (FilmFrame& frame : film.frames) frame.camera_to_world.reset();
  const std::vector<TrailPoint> points = Trails(film, 5).at(2)[0].points;
  REQUIRE(points.size() == 3);
  CHECK(points[0].y_px == 4);
  CHECK(points[1].y_px == 7.75);
}

TEST_CASE("A trail forgets what is too long ago, and what the edge of the picture cut") {
  ClipFilm film = film_of_still_target();
  CHECK(Trails(film, 1).at(2)[0].points.size() == 2);
  CHECK(Trails(film, 0.5).at(2).empty());
  CHECK(Trails(film, 5).at(0).empty());
  film.labels.labels[0].truncated = true;
  CHECK(Trails(film, 5).at(2)[0].points.size() == 2);
}

}  // namespace trails_test
