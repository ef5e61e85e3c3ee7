// The calibrations of tests/data/calibrations, read by us and by OpenCV, projected and un-projected by both.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>

#include "io/config/calibration_file.h"
#include "support/catch.h"

namespace calibrations_test {

using namespace thermal;

namespace {

constexpr int kSide = 100;  // points along either side of a picture: 10^4 in all

/// A file, and the keys that its matrices have.
struct Layout {
  const char* file;
  const char* camera_matrix;
  const char* coefficients;
};

const std::vector<Layout> kLayouts = {{"left_intrinsics.yml", "camera_matrix", "distortion_coefficients"},
                                      {"out_camera_data.xml", "Camera_Matrix", "Distortion_Coefficients"},
                                      {"thermal.json", "camera_matrix", "distortion_coefficients"},
                                      {"interactive.xml", "cameraMatrix", "dist_coeffs"},
                                      {"rational.yml", "camera_matrix", "distortion_coefficients"}};

Path path_of(const std::string& file) { return Path(VELDT_SOURCE_DIR) / "tests/data/calibrations" / file; }

/// A camera as OpenCV has it.
struct Oracle {
  cv::Mat camera_matrix;
  cv::Mat coefficients;

  /// Where points at depth 1 are seen, in OpenCV's pixels.
  [[nodiscard]] std::vector<cv::Point2d> project(const std::vector<cv::Point3d>& points) const {
    std::vector<cv::Point2d> seen_px;
    cv::projectPoints(points, cv::Vec3d::zeros(), cv::Vec3d::zeros(), camera_matrix, coefficients, seen_px);
    return seen_px;
  }

  /// The points at depth 1 that are seen there. Its steps gain a digit each or so; it ends below 1e-12 px.
  [[nodiscard]] std::vector<cv::Point2d> unproject(const std::vector<cv::Point2d>& seen_px) const {
    std::vector<cv::Point2d> points;
    cv::undistortPoints(seen_px, points, camera_matrix, coefficients, cv::noArray(), cv::noArray(),
                        cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 10000, 1e-12));
    return points;
  }
};

Oracle read_by_opencv(const Layout& layout) {
  const cv::FileStorage storage(path_of(layout.file).string(), cv::FileStorage::READ);
  Oracle oracle;
  storage[layout.camera_matrix] >> oracle.camera_matrix;
  storage[layout.coefficients] >> oracle.coefficients;
  return oracle;
}

/// OpenCV has no header to know ROS' files by.
Oracle made_of(const Calibration& found) {
  const auto& [camera, lens] = found;
  return {.camera_matrix = (cv::Mat_<double>(3, 3) << camera.fx_px, 0, camera.cx_px - 0.5, 0, camera.fy_px,
                            camera.cy_px - 0.5, 0, 0, 1),
          .coefficients = (cv::Mat_<double>(1, 5) << lens.k1, lens.k2, lens.p1, lens.p2, lens.k3)};
}

/// Places all over the picture and on its border.
std::vector<PicturePoint> places_in(const CameraIntrinsics& camera) {
  std::vector<PicturePoint> places;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x)
      places.push_back({x * camera.width_px / (kSide - 1.0), y * camera.height_px / (kSide - 1.0)});
  }
  return places;
}

/// The largest distance, in px, between what we and OpenCV say; first where points are seen, then what is seen at
/// places, in a pinhole's px.
std::pair<double, double> largest_errors_px(const Calibration& found, const Oracle& oracle) {
  const auto& [camera, lens] = found;
  std::vector<LensPoint> ours;
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> places_px;
  for (const PicturePoint& place : places_in(camera)) {
    ours.push_back(unproject(camera, lens, place));
    points.emplace_back(ours.back().x, ours.back().y, 1);
    places_px.emplace_back(place.u_px - 0.5, place.v_px - 0.5);
  }
  const std::vector<cv::Point2d> seen_px = oracle.project(points);
  const std::vector<cv::Point2d> theirs = oracle.unproject(places_px);
  double projected_px = 0;
  double unprojected_px = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const PicturePoint seen = project(camera, lens, ours[i]);
    projected_px =
        std::max(projected_px, std::hypot(seen.u_px - 0.5 - seen_px[i].x, seen.v_px - 0.5 - seen_px[i].y));
    unprojected_px = std::max(unprojected_px, std::hypot(camera.fx_px * (ours[i].x - theirs[i].x),
                                                         camera.fy_px * (ours[i].y - theirs[i].y)));
  }
  return {projected_px, unprojected_px};
}

void check(const Calibration& found, const Oracle& oracle) {
  const auto [projected_px, unprojected_px] = largest_errors_px(found, oracle);
  INFO(fmt::format("projected to {:.2g} px, un-projected to {:.2g} px", projected_px, unprojected_px));
  // Some 30 roundings of 1.1e-16 on coordinates below 1 each, times up to 1300 px: 5e-12 px.
  CHECK(projected_px <= 1e-11);
  // undistort() promises 1e-12 at depth 1, which is 1.3e-9 px; OpenCV ends at 1e-12 px.
  CHECK(unprojected_px <= 1e-8);
}

}  // namespace

TEST_CASE("OpenCV's layouts are read, projected and un-projected as OpenCV does") {
  for (const Layout& layout : kLayouts) {
    CAPTURE(layout.file);
    const Calibration found = read_calibration(path_of(layout.file));
    const Oracle oracle = read_by_opencv(layout);
    // Half a pixel lies between the two conventions: 0.5 is exact, the sum rounds once.
    const cv::Mat_<double>& matrix = oracle.camera_matrix;
    CHECK(found.camera.fx_px == matrix(0, 0));
    CHECK(found.camera.fy_px == matrix(1, 1));
    CHECK(found.camera.cx_px == matrix(0, 2) + 0.5);
    CHECK(found.camera.cy_px == matrix(1, 2) + 0.5);
    CHECK(found.lens.k3 == oracle.coefficients.at<double>(4));
    check(found, oracle);
  }
}

TEST_CASE("ROS' layout is read, projected and un-projected as OpenCV does with its numbers") {
  const Calibration found = read_calibration(path_of("ost.yaml"));
  CHECK(found.camera.width_px == 640);
  CHECK(found.camera.height_px == 480);
  CHECK(found.camera.fx_px == 526.6908296825479);
  CHECK(found.camera.fy_px == 525.7542623070541);
  CHECK(found.camera.cx_px == 312.3333507245396 + 0.5);
  CHECK(found.camera.cy_px == 246.2279496394374 + 0.5);
  CHECK(found.lens == LensDistortion{.k1 = 0.01864117263397289,
                                     .k2 = -0.0807953154457166,
                                     .p1 = 0.0006701578887838996,
                                     .p2 = -0.001800282263098739});
  check(found, made_of(found));
}

TEST_CASE("The middle of the first pixel is at (0.5, 0.5) here and at (0, 0) there") {
  const Calibration found = read_calibration(path_of("thermal.json"));
  const std::vector<cv::Point2d> there = made_of(found).unproject({{0, 0}});
  const LensPoint here = unproject(found.camera, found.lens, {0.5, 0.5});
  // Half a pixel is 4e-4 at depth 1.
  CHECK_THAT(here.x, WithinAbs(there[0].x, 1e-11));
  CHECK_THAT(here.y, WithinAbs(there[0].y, 1e-11));
}

}  // namespace calibrations_test
