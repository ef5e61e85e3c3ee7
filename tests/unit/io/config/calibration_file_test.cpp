#include "io/config/calibration_file.h"

#include <fmt/format.h>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace calibration_file_test {

using namespace thermal;

namespace {

const std::string kMatrix = "[ 500., 0., 321., 0., 510., 243., 0., 0., 1. ]";

std::string matrix_of(const std::string& key, int rows, int columns, const std::string& data) {
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: {}\n", key, rows,
                     columns, data);
}

std::string lens_of(const std::string& data, int count) {
  return matrix_of("distortion_coefficients", 1, count, data);
}

/// As calibration.cpp writes it.
std::string yaml_of(const std::string& lens = lens_of("[ -0.3, 0.1, 0.001, -0.002, -0.05 ]", 5),
                    const std::string& matrix = matrix_of("camera_matrix", 3, 3, kMatrix),
                    const std::string& size = "image_width: 640\nimage_height: 480\n") {
  return "%YAML:1.0\n---\n" + size + matrix + lens;
}

/// As ROS' camera_calibration writes it.
std::string ros_of(const std::string& more = "distortion_model: plumb_bob\n") {
  return "image_width: 640\nimage_height: 480\ncamera_name: left\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
         "  data: [500, 0, 321, 0, 510, 243, 0, 0, 1]\n" +
         more + "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [-0.3, 0.1, 0.001, -0.002, -0.05]\n";
}

void check_is_the_one(const Calibration& found) {
  CHECK(found.camera.width_px == 640);
  CHECK(found.camera.height_px == 480);
  CHECK(found.camera.fx_px == 500);
  CHECK(found.camera.fy_px == 510);
  CHECK(found.camera.cx_px == 321.5);
  CHECK(found.camera.cy_px == 243.5);
  CHECK(found.lens == LensDistortion{.k1 = -0.3, .k2 = 0.1, .p1 = 0.001, .p2 = -0.002, .k3 = -0.05});
}

std::string fault_in(const std::string& text) {
  return message_of<ConfigError>([&] { (void)parse_calibration(text, "cal.yml"); });
}

}  // namespace

TEST_CASE("A calibration is read from YAML, with a byte-order mark and other line ends too") {
  check_is_the_one(parse_calibration(yaml_of(), "cal.yml"));
  check_is_the_one(parse_calibration("\xEF\xBB\xBF" + yaml_of(), "cal.yml"));
  std::string with_crlf;
  for (const char letter : yaml_of()) with_crlf += letter == '\n' ? "\r\n" : std::string(1, letter);
  check_is_the_one(parse_calibration(with_crlf, "cal.yml"));
}

TEST_CASE("A calibration is read from JSON and XML") {
  check_is_the_one(parse_calibration(
      R"({"image_width": 640, "image_height": 480,
          "camera_matrix": {"type_id": "opencv-matrix", "rows": 3, "cols": 3, "dt": "d",
                            "data": [500, 0, 321.0, 0, 510, 243.0, 0, 0, 1]},
          "distortion_coefficients": {"type_id": "opencv-matrix", "rows": 5, "cols": 1, "dt": "d",
                                      "data": [-0.3, 0.1, 0.001, -0.002, -0.05]}})",
      "cal.json"));
  check_is_the_one(parse_calibration(
      "<?xml version=\"1.0\"?>\n<opencv_storage>\n<image_Width>640</image_Width>\n"
      "<image_Height>480</image_Height>\n<Camera_Matrix "
      "type_id=\"opencv-matrix\"><rows>3</rows><cols>3</cols>"
      "<dt>d</dt>\n<data>500. 0. 321. 0. 510. 243. 0. 0. 1.</data></Camera_Matrix>\n"
      "<Distortion_Coefficients type_id=\"opencv-matrix\"><rows>1</rows><cols>5</cols><dt>d</dt>\n"
      "<data>-0.3 0.1 0.001 -0.002 -0.05</data></Distortion_Coefficients>\n</opencv_storage>\n",
      "cal.xml"));
}

TEST_CASE("ROS' camera_info is read, with a header or without, its lists in brackets or below each other") {
  check_is_the_one(parse_calibration(ros_of(), "ost.yaml"));
  check_is_the_one(parse_calibration("%YAML:1.0\n---\n" + ros_of(), "ost.yaml"));
  check_is_the_one(parse_calibration("---\n" + ros_of(), "ost.yaml"));
  check_is_the_one(parse_calibration(
      "camera_matrix:\n  cols: 3\n  data:\n  - 500.0\n  - 0.0\n  - 321.0\n  - 0.0\n  - 510.0\n  - 243.0\n"
      "  - 0.0\n  - 0.0\n  - 1.0\n  rows: 3\ndistortion_coefficients:\n  cols: 5\n  data:\n  - -0.3\n  - "
      "0.1\n"
      "  - 0.001\n  - -0.002\n  - -0.05\n  rows: 1\ndistortion_model: plumb_bob\nimage_height: 480\n"
      "image_width: 640\n",
      "ost.yaml"));
  check_is_the_one(parse_calibration(
      ros_of(
          "rectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"
          "projection_matrix:\n  rows: 3\n  cols: 4\n  data: [480, 0, 322, 0, 0, 490, 244, 0, 0, 0, 1, 0]\n"),
      "ost.yaml"));
}

TEST_CASE("Comments behind values, and maps in braces, are read") {
  check_is_the_one(
      parse_calibration("# of the left camera\nimage_width: 640 # px\nimage_height: 480\ncamera_matrix: # as "
                        "in OpenCV\n  rows: 3\n"
                        "  cols: 3\n  data: [500, 0, 321, # fx\n    0, 510, 243, 0, 0, 1]  # row by "
                        "row\ndistortion_model: 'plumb_bob'  "
                        "# Brown-Conrady\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n  data: # k1 k2 p1 "
                        "p2 k3\n  - -0.3 # k1\n  - "
                        "0.1\n  - 0.001\n  - -0.002\n  - -0.05\n",
                        "ost.yaml"));
  const std::string braces =
      "{image_width: 640, image_height: 480, camera_name: left, camera_matrix: {rows: 3, cols: 3, data: "
      "[500.0, "
      "0, 321, 0, 510.0, 243, 0, 0, 1]}, distortion_model: plumb_bob,\n distortion_coefficients: {rows: 1, "
      "cols: 5, "
      "data: [-0.3, 0.1, 0.001, -0.002, -0.05,]}}";
  check_is_the_one(parse_calibration("# one line\n" + braces + " # end\n", "ost.yaml"));
  check_is_the_one(parse_calibration("---\n" + braces + "\n...\n", "ost.yaml"));
}

TEST_CASE("A camera_info message is read, of ROS 2 or 1, and is of the whole picture") {
  const std::string header = "header:\n  stamp:\n    sec: 1700000000\n    nanosec: 0\n  frame_id: ''\n";
  const std::string message =
      header +
      "height: 480\nwidth: 640\ndistortion_model: plumb_bob\nd:\n- -0.3\n- 0.1\n- 0.001\n- "
      "-0.002\n- -0.05\nk:\n- 500.0\n- 0.0\n- 321.0\n- 0.0\n- 510.0\n- 243.0\n- 0.0\n- 0.0\n- "
      "1.0\n";
  check_is_the_one(parse_calibration(message + "---\n", "topic.yaml"));
  const std::string roi =
      "roi:\n  x_offset: 0\n  y_offset: 0\n  height: 0\n  width: 0\n  do_rectify: false\n";
  check_is_the_one(parse_calibration(message + "binning_x: 0\nbinning_y: 1\n" + roi, "topic.yaml"));
  check_is_the_one(
      parse_calibration("height: 480\nwidth: 640\nD: [-0.3, 0.1, 0.001, -0.002, -0.05]\nK: [500.0, 0.0, "
                        "321.0, 0.0, 510.0, 243.0, 0.0, "
                        "0.0, 1.0]\nR: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]\n---\n",
                        "topic.yaml"));
  CHECK(fault_in(message + "---\n" + message) ==
        "cal.yml:26: expected one document, such as one message of a topic");
  CHECK(fault_in(message + "binning_x: 2\n") ==
        "cal.yml: binning_x = 2; expected 0 or 1: binned pictures are not supported");
  CHECK(fault_in(message + "roi:\n  x_offset: 0\n  width: 320\n") ==
        "cal.yml: roi.width = 320 px; expected 0: parts of pictures are not supported");
  CHECK(fault_in(message + "r: [1, 0, 0, 0, 1, 0, 0, 0]\n") == "cal.yml: r = 8 numbers; expected 9");
  CHECK(fault_in(message + "r: [1, 0, 0, 0, 0.5, 0, 0, 0, 1]\n")
            .starts_with("cal.yml: r[4] = 0.5; expected 1: of a stereo pair's camera"));
}

TEST_CASE("Names in other letters are read, and shown where they are wrong") {
  check_is_the_one(parse_calibration(ros_of("camera_maker: W\xC3\xA4rme \xFF\n"), "ost.yaml"));
  CHECK(fault_in(ros_of("camera_model: \xFF\n")) ==
        "cal.yml: camera_model = \\xff; expected pinhole: no other is supported");
  CHECK(fault_in("\xFF: 1\n\xFF: 2\n") == "cal.yml:2: expected \\xff once");
}

TEST_CASE("Kalibr's camchain is read if it is of one pinhole camera") {
  const auto chain = [](const std::string& camera, const std::string& model = "pinhole",
                        const std::string& distortion = "radtan", const std::string& k = "-0.3") {
    return camera + ":\n  cam_overlaps: []\n  camera_model: " + model + "\n  distortion_coeffs: [" + k +
           ", 0.1, 0.001, -0.002]\n  distortion_model: " + distortion +
           "\n  intrinsics: [500.0, 510.0, 321.0, 243.0]\n  resolution: [640, 480]\n  rostopic: "
           "/thermal/image_raw\n"
           "  T_cn_cnm1:\n  - [1.0, 0.0, 0.0, 0.0]\n  - [0.0, 1.0, 0.0, 0.0]\n";
  };
  for (const char* const camera : {"cam0", "cam1"}) {
    Calibration found = parse_calibration(chain(camera), "camchain.yaml");
    CHECK(found.lens.k3 == 0);
    found.lens.k3 = -0.05;
    check_is_the_one(found);
  }
  CHECK(fault_in(chain("cam0") + chain("cam1")) ==
        "cal.yml: cameras cam0, cam1; expected one, so leave the others out");
  CHECK(fault_in(chain("cam0", "omni")) ==
        "cal.yml: cam0.camera_model = omni; expected pinhole: no other is supported");
  CHECK(fault_in(chain("cam0", "pinhole", "equidistant"))
            .starts_with("cal.yml: cam0.distortion_model = equidistant; expected plumb_bob, radtan"));
  CHECK(fault_in(chain("cam0", "pinhole", "radtan", "x")) ==
        "cal.yml: cam0.distortion_coeffs[0] = x; expected a number");
  CHECK(fault_in(chain("cam0", "pinhole", "radtan", "1, 2")) ==
        "cal.yml: cam0.distortion_coeffs = a list of 5; expected k1, k2, p1 and p2");
  CHECK(fault_in("cam0:\n  intrinsics: [1, 2, 3, 4]\n") ==
        "cal.yml: cam0.camera_model is missing; expected it to be given");
}

TEST_CASE("What YAML has beyond calibrations is refused by name") {
  CHECK(fault_in("a: &b 1\n") == "cal.yml:1: expected no anchor (&)");
  CHECK(fault_in("a: [ *b ]\n") == "cal.yml:1: expected no alias (*)");
  CHECK(fault_in("a: !!float 1\n") == "cal.yml:1: expected no tag (!) but !!opencv-matrix");
  CHECK(fault_in("a: |\n  b\n") == "cal.yml:1: expected no block text (|)");
  CHECK(fault_in("a: >-\n  b\n") == "cal.yml:1: expected no block text (>)");
  CHECK(fault_in("? a\n: b\n") == "cal.yml:1: expected no key of several lines (?)");
  CHECK(fault_in("a:\n  <<: b\n") == "cal.yml:2: expected no merged keys (<<)");
  CHECK(fault_in("%TAG ! a\n---\na: 1\n") == "cal.yml:1: expected no directive but %YAML");
  CHECK(fault_in("a: 1\n---\nb: 2\n") == "cal.yml:3: expected one document, such as one message of a topic");
}

TEST_CASE("Numbers of a calibration are decimal, whatever the locale") {
  const auto size = [](const std::string& width) {
    return fault_in("image_width: " + width + "\nimage_height: 480\n");
  };
  const std::string whole = "; expected a whole number from 1 to 100000";
  for (const char* const odd : {"0640", "0x280", "6_40", "640,5", "1:40", "1e999", "nan", "inf"})
    CHECK(size(odd) == fmt::format("cal.yml: image_width = {}; expected a number", odd));
  CHECK(size("640.5") == "cal.yml: image_width = 640.5" + whole);
  for (const char* const fine : {"640", "+640", "640.", "6.4e2", "64.0E+1"})
    CHECK(size(fine).starts_with("cal.yml: camera_matrix is missing"));
  check_is_the_one(parse_calibration("%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\n" +
                                         matrix_of("camera_matrix", 3, 3, "[500,0,321,0,510,243,0,0,1]") +
                                         lens_of("[-0.3,0.1,0.001,-0.002,-0.05]", 5),
                                     "cal.yml"));
}

TEST_CASE("Other names that OpenCV's programs have had are known") {
  check_is_the_one(parse_calibration(
      "%YAML:1.0\n---\ncameraResolution: [ 640, 480 ]\n" + matrix_of("cameraMatrix", 3, 3, kMatrix) +
          matrix_of("dist_coeffs", 1, 5, "[ -0.3, 0.1, 0.001, -0.002, -0.05 ]"),
      "params.yml"));
}

TEST_CASE("Four coefficients are without k3, and more than five may be 0") {
  CHECK(parse_calibration(yaml_of(lens_of("[ -0.3, 0.1, 0.001, -0.002 ]", 4)), "cal.yml").lens ==
        LensDistortion{.k1 = -0.3, .k2 = 0.1, .p1 = 0.001, .p2 = -0.002});
  check_is_the_one(
      parse_calibration(yaml_of(lens_of("[ -0.3, 0.1, 0.001, -0.002, -0.05, 0., 0., 0. ]", 8)), "cal.yml"));
  check_is_the_one(parse_calibration(
      yaml_of(lens_of("[ -0.3, 0.1, 0.001, -0.002, -0.05, 0., 0., 0., 0., 0., 0., 0., 0., 0. ]", 14)),
      "cal.yml"));
}

TEST_CASE("Lenses that are not modelled are refused by name") {
  CHECK(fault_in(yaml_of(lens_of("[ -0.3, 0.1, 0., 0., 0., 0., 0.25, 0. ]", 8))) ==
        "cal.yml: distortion_coefficients: k5 = 0.25; expected 0: the rational model is not supported");
  CHECK(fault_in(yaml_of(lens_of("[ -0.3, 0.1, 0., 0., 0., 0., 0., 0., 0.5, 0., 0., 0. ]", 12))) ==
        "cal.yml: distortion_coefficients: s1 = 0.5; expected 0: the thin-prism model is not supported");
  CHECK(fault_in(yaml_of(lens_of("[ -0.3, 0.1, 0., 0., 0., 0., 0., 0., 0., 0., 0., 0., 0., 0.125 ]", 14))) ==
        "cal.yml: distortion_coefficients: tau_y = 0.125; expected 0: the tilted model is not supported");
  CHECK(fault_in("%YAML:1.0\n---\nfisheye_model: 1\n") ==
        "cal.yml: fisheye_model = 1; expected 0: fisheye lenses are not supported");
  CHECK(
      fault_in(ros_of("distortion_model: equidistant\n")) ==
      "cal.yml: distortion_model = equidistant; expected plumb_bob, radtan, or rational_polynomial whose k4 "
      "to k6 are 0");
  CHECK(fault_in(ros_of("camera_model: fisheye\n")) ==
        "cal.yml: camera_model = fisheye; expected pinhole: no other is supported");
  CHECK(fault_in(ros_of("model_type: KANNALA_BRANDT\n")) ==
        "cal.yml: model_type = KANNALA_BRANDT; expected pinhole: no other is supported");
  CHECK(fault_in(ros_of("is_fisheye: true\n")) ==
        "cal.yml: is_fisheye = true; expected 0: fisheye lenses are not supported");
  CHECK(fault_in(ros_of("xi: 1.25\n")) ==
        "cal.yml: xi = 1.25; expected none: omnidirectional lenses are not supported");
  check_is_the_one(parse_calibration(ros_of("camera_model: PINHOLE\nis_fisheye: false\n"), "ost.yaml"));
  CHECK(fault_in(yaml_of(lens_of("[ 0., 0., 0. ]", 3))) ==
        "cal.yml: distortion_coefficients = 3 numbers; expected 4, 5, 8, 12 or 14, in OpenCV's order");
}

TEST_CASE("One of several cameras is refused, and what to do about it said") {
  CHECK(fault_in("%YAML:1.0\n---\n" + matrix_of("M1", 3, 3, kMatrix)) ==
        "cal.yml: M1 is a stereo calibration's, which does not say for what size of picture; expected "
        "image_width, image_height, camera_matrix and distortion_coefficients of one camera");
  CHECK(
      fault_in(
          ros_of("rectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 0.5, 0, 0, 0, 1]\n")) ==
      "cal.yml: rectification_matrix.data[4] = 0.5; expected 1: of a stereo pair's camera the raw picture is "
      "made, so leave rectification_matrix out");
}

TEST_CASE("What is missing or makes no camera is named") {
  const std::string lens = lens_of("[ 0., 0., 0., 0. ]", 4);
  const auto with_matrix = [&](const std::string& data, int rows = 3) {
    return fault_in(yaml_of(lens, matrix_of("camera_matrix", rows, 3, data)));
  };
  CHECK(fault_in(yaml_of("")) ==
        "cal.yml: distortion_coefficients is missing; expected one of distortion_coefficients, dist_coeffs, "
        "Distortion_Coefficients, D, d");
  CHECK(
      fault_in(yaml_of(lens, "")) ==
      "cal.yml: camera_matrix is missing; expected one of camera_matrix, cameraMatrix, Camera_Matrix, K, k");
  CHECK(fault_in(yaml_of(lens, matrix_of("camera_matrix", 3, 3, kMatrix), "image_height: 480\n")) ==
        "cal.yml: image_width is missing; expected one of image_width, image_Width, width");
  CHECK(fault_in(yaml_of(lens, matrix_of("camera_matrix", 3, 3, kMatrix),
                         "image_width: 640.5\nimage_height: 480\n")) ==
        "cal.yml: image_width = 640.5; expected a whole number from 1 to 100000");
  CHECK(with_matrix("[ 500., 0.25, 321., 0., 510., 243., 0., 0., 1. ]") ==
        "cal.yml: camera_matrix.data[1] = 0.25; expected 0: skewed pixels are not supported");
  CHECK(with_matrix("[ 500., 0., 321., 0., 510., 243., 0., 0., 2. ]") ==
        "cal.yml: camera_matrix.data[8] = 2; expected 1");
  CHECK(with_matrix("[ 500., 0., 321., 0., 510., 243., 0., 0. ]") ==
        "cal.yml: camera_matrix.data = 8 numbers; expected 9");
  CHECK(with_matrix("[ 500., 0., 321., 0., 510., 243. ]", 2) ==
        "cal.yml: camera_matrix = 2 x 3; expected 3 x 3");
  CHECK(with_matrix("[ .Nan, 0., 321., 0., 510., 243., 0., 0., 1. ]") ==
        "cal.yml: camera_matrix.data[0] = nan; expected a number");
  CHECK(with_matrix("[ .Inf, 0., 321., 0., 510., 243., 0., 0., 1. ]") ==
        "cal.yml: camera_matrix.data[0] = inf; expected a number");
  CHECK(with_matrix("[ abc, 0., 321., 0., 510., 243., 0., 0., 1. ]") ==
        "cal.yml: camera_matrix.data[0] = abc; expected a number");
  CHECK(with_matrix("17") ==
        "cal.yml: camera_matrix = keys; expected rows, cols and data, a list of numbers");
  CHECK(fault_in(yaml_of(lens, "camera_matrix: 3\n")) ==
        "cal.yml: camera_matrix = 3; expected rows, cols and data, a list of numbers");
}

TEST_CASE("A size that no file fills is not made room for") {
  CHECK(fault_in(
            yaml_of(lens_of("[ 0., 0., 0., 0. ]", 4), matrix_of("camera_matrix", 99999, 99999, kMatrix))) ==
        "cal.yml: camera_matrix = 99999 x 99999; expected 3 x 3");
  CHECK(fault_in(yaml_of(lens_of("[ 0., 0., 0., 0. ]", 99999))) ==
        "cal.yml: distortion_coefficients.data = 4 numbers; expected 99999");
}

TEST_CASE("A text that is no calibration is refused, and the line said") {
  CHECK(fault_in("") == "cal.yml: no keys; expected some, such as camera_matrix");
  CHECK(fault_in("%YAML:1.0\n---\na: [ 1, , 2 ]\n") == "cal.yml:3: expected a value behind , [ or :");
  CHECK(fault_in("%YAML:1.0\n---\na: [ 1, 2\n") == "cal.yml:4: expected ] where the list ends");
  CHECK(fault_in("{a: 1, b: {c: 2\n") == "cal.yml:2: expected } where the map ends");
  CHECK(fault_in("a: [ 1, {2} ]\n") == "cal.yml:1: expected key: value in a map");
  CHECK(fault_in("a: [ 1, b: 2 ]\n") == "cal.yml:1: expected numbers and , in a list");
  CHECK(fault_in("a: [ 1 ] 2\n") == "cal.yml:1: expected nothing behind the list");
  CHECK(fault_in("{a: 1} b\n") == "cal.yml:1: expected nothing behind the map");
  CHECK(fault_in("a: " + std::string(20, '[')) == "cal.yml:1: expected lists less deep");
  CHECK(fault_in("a: 1\nb: 2\na: 3\n") == "cal.yml:3: expected a once");
  CHECK(fault_in("a:\n\tb: 1\n") == "cal.yml:2: expected spaces before a key, not tabs");
  CHECK(fault_in("[ 1, 2 ]") == "cal.yml:1: expected key: value");
  CHECK(fault_in("a:\n   b: 1\n   : 2\n") == "cal.yml:3: expected key: value");
  const std::string indent = "expected as many spaces as a line above has";
  CHECK(fault_in("- 10\n i:\n- 0\n- 3\n") == "cal.yml:1: expected key: value");
  CHECK(fault_in("a:\n- 10\n i:\n- 0\n") == "cal.yml:3: " + indent);
  CHECK(fault_in("a:\n   b: 1\n c: 2\n") == "cal.yml:3: " + indent);
  CHECK(fault_in("a: 1\n   b: 1\n") == "cal.yml:2: " + indent);
  CHECK(fault_in("a:\n   b:\n      c: 1\n d: 1\n") == "cal.yml:4: " + indent);
  const std::string value = "expected a number, a word, a string in quotes, a list in [ ] or a map in { }";
  CHECK(fault_in("a: b: c\n") == "cal.yml:1: " + value);
  CHECK(fault_in("a: - 1\n") == "cal.yml:1: " + value);
  CHECK(fault_in("a: \"b\n") == "cal.yml:1: expected a string in quotes, without others in it");
  CHECK(fault_in("a: 1\n%YAML:1.0\n") == "cal.yml:2: expected key: value");
  const std::string xml = "<?xml version=\"1.0\"?>\n";
  CHECK(fault_in("<?xml version=") == "cal.yml:1: expected <?xml version=\"1.0\"");
  CHECK(fault_in(xml + "<a>1</a>\n") == "cal.yml:2: expected one <opencv_storage>");
  CHECK(fault_in(xml + "<opencv_storage>\n<a>1</b>\n") ==
        "cal.yml:3: expected the end of the last tag that has none");
  CHECK(fault_in(xml + "<opencv_storage>\n<a>&lt;</a>\n") ==
        "cal.yml:3: expected numbers, words or a string between two tags");
  CHECK(fault_in(xml + "<opencv_storage>\n<a") == "cal.yml:3: expected >");
  CHECK(fault_in(xml + "<opencv_storage>\n1\n</opencv_storage>") == "cal.yml:3: expected a tag");
  CHECK(fault_in(xml + "<opencv_storage>\n<!-- a\n") == "cal.yml:3: expected -->");
  CHECK(fault_in(xml) == "cal.yml:2: expected </opencv_storage>");
  CHECK(fault_in("{\"image_width\": 640,").starts_with("cal.yml:1:"));
}

TEST_CASE("What is larger or deeper than a calibration is not read") {
  CHECK(fault_in(std::string(1 << 20, ' ') + "a") ==
        "cal.yml: more than 1048576 bytes; expected at most that many in a calibration");
  CHECK(fault_in(std::string("%YAML:1.0\n\0", 11)) ==
        "cal.yml: control characters; expected a text: YAML, XML or JSON");
  CHECK(fault_in("%YAML:1.0\n---\ncamera_matrix: !!binary |\n  AAAA\n") ==
        "cal.yml: !!binary; expected numbers in plain text");
  const std::string too_many =
      "cal.yml: more than 4000 brackets, tags and keys; expected a calibration of one camera";
  std::string dashes = "a:\n  ";
  std::string keys = "%YAML:1.0\n---\n";
  for (int i = 0; i < 100000; ++i) dashes += "- ";
  for (int i = 0; i < 100000; ++i) keys += "a: ";
  CHECK(fault_in(std::string(100000, '[')) == too_many);
  CHECK(fault_in("{\"a\":" + std::string(100000, '{')) == too_many);
  CHECK(fault_in(dashes) == too_many);
  CHECK(fault_in(keys) == too_many);
}

TEST_CASE("Only a file is read") {
  const TestFolder folder;
  CHECK(message_of<IoError>([] { (void)read_calibration("/dev/zero"); }) ==
        "cannot read /dev/zero: it is a pipe or a device; expected a file");
  CHECK(message_of<IoError>([&] { (void)read_calibration(folder.path()); }) ==
        fmt::format("cannot read {}: it is a folder; expected a file", folder.path().string()));
  check_is_the_one(read_calibration(folder.file("cal.yml", yaml_of())));
  const Path large = folder.file("large.yml", std::string(3 << 20, '#'));
  CHECK(message_of<ConfigError>([&] { (void)read_calibration(large); }) ==
        large.string() + ": more than 1048576 bytes; expected at most that many in a calibration");
}

}  // namespace calibration_file_test
