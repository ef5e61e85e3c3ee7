#include "io/config/calibration_file.h"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/config/calibration_tree.h"

namespace thermal {
namespace {

/// Coefficients beyond the five that we model, in OpenCV's order: all of them or none.
struct Unmodelled {
  const char* name;
  const char* model;
};
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kModelled = 5;  // k1, k2, p1, p2, k3
constexpr std::array<Unmodelled, 9> kUnmodelled = {{{"k4", "rational"},
                                                    {"k5", "rational"},
                                                    {"k6", "rational"},
                                                    {"s1", "thin-prism"},
                                                    {"s2", "thin-prism"},
                                                    {"s3", "thin-prism"},
                                                    {"s4", "thin-prism"},
                                                    {"tau_x", "tilted"},
                                                    {"tau_y", "tilted"}}};

struct Model {
  const char* key;
  const char* value;
};
// One that does not have the value has another meaning, whatever else is there.
constexpr std::array<Model, 4> kModels = {{{"camera_model", "pinhole"},
                                           {"camera_type", "pinhole"},
                                           {"lens_model", "pinhole"},
                                           {"model_type", "pinhole"}}};

/// The parts of one camera, by the names in use for them; `prefix` is what its keys are within.
class Reader {
 public:
  Reader(const Json& root, const std::string& name, std::string prefix = "")
      : root_(root), name_(name), prefix_(std::move(prefix)) {}

  [[nodiscard]] Calibration read() const {
    if (!root_.is_object()) throw ConfigError(name_ + ": no keys; expected some, such as camera_matrix");
    Calibration found;
    if (prefix_.empty()) {
      if (const std::string camera = only_camera(); !camera.empty())
        return Reader(at(camera), name_, camera + ".").read();
    }
    check_kind();
    if (prefix_.empty()) {
      read_size(found.camera);
      check_part(found.camera);
      read_camera_matrix(found.camera);
      read_distortion(found.lens);
    } else {
      read_kalibr(found);
    }
    return found;
  }

 private:
  [[nodiscard]] ConfigError fault_of(std::string_view where, std::string_view value, std::string_view unit,
                                     std::string_view rule) const {
    return ConfigError(name_ + ": " + prefix_ + fault(where, value, unit, rule));
  }

  /// A key's value; null if it is missing.
  [[nodiscard]] const Json& at(const std::string& key) const {
    static const Json kMissing;
    const auto found = root_.find(key);
    return found == root_.end() ? kMissing : *found;
  }

  /// The first key of these that is there; empty if none is.
  [[nodiscard]] std::string key_of(std::span<const std::string> keys) const {
    for (const std::string& key : keys) {
      if (!at(key).is_null()) return key;
    }
    return "";
  }

  [[nodiscard]] std::string needed_key(std::span<const std::string> keys) const {
    std::string key = key_of(keys);
    if (key.empty()) {
      throw ConfigError(fmt::format("{}: {}{} is missing; expected {}", name_, prefix_, keys.front(),
                                    keys.size() == 1 ? "it to be given" : "one of " + list_names(keys)));
    }
    return key;
  }

  /// The key of a camchain's camera, cam0 or another; empty if the file is none.
  [[nodiscard]] std::string only_camera() const {
    std::vector<std::string> cameras;
    for (const auto& [key, value] : root_.items()) {
      const bool is_camera = key.starts_with("cam") && number_in<int>(std::string_view(key).substr(3));
      if (is_camera && value.is_object()) cameras.push_back(key);
    }
    if (cameras.size() > 1) {
      throw ConfigError(
          fmt::format("{}: cameras {}; expected one, so leave the others out", name_, list_names(cameras)));
    }
    return cameras.empty() ? "" : cameras.front();
  }

  /// That the file is about one camera, of a kind that there is a model for.
  void check_kind() const {
    if (!at("M1").is_null()) {
      throw ConfigError(
          name_ +
          ": M1 is a stereo calibration's, which does not say for what size of picture; expected "
          "image_width, image_height, camera_matrix and distortion_coefficients of one camera");
    }
    for (const auto& [key, value] : root_.items()) {
      if (lower_case(key).find("fisheye") == std::string::npos) continue;
      if (value != 0 && lower_case(text_of(value)) != "false")
        throw fault_of(text_of(key), text_of(value), "", "0: fisheye lenses are not supported");
    }
    if (!at("xi").is_null())
      throw fault_of("xi", text_of(at("xi")), "", "none: omnidirectional lenses are not supported");
    for (const auto& [key, expected] : kModels) {
      const Json& model = at(key);
      if (!model.is_null() && lower_case(text_of(model)) != expected)
        throw fault_of(key, text_of(model), "", fmt::format("{}: no other is supported", expected));
    }
    const std::string model = "distortion_model";
    if (!at(model).is_null() && text_of(at(model)) != "plumb_bob" && text_of(at(model)) != "radtan" &&
        text_of(at(model)) != "rational_polynomial") {
      throw fault_of(model, text_of(at(model)), "",
                     "plumb_bob, radtan, or rational_polynomial whose k4 to k6 are 0");
    }
    check_rectification();
  }

  void check_rectification() const {
    static const std::array<std::string, 3> kKeys = {"rectification_matrix", "R", "r"};
    const std::string key = key_of(kKeys);
    if (key.empty()) return;
    const std::vector<double> values = matrix(key, 3, 3);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double expected = i % 4 == 0 ? 1 : 0;
      if (values[i] == expected) continue;
      throw fault_of(entry_of(key, i), fmt::format("{}", values[i]), "",
                     fmt::format("{}: of a stereo pair's camera the raw picture is made, so leave {} out",
                                 expected, key));
    }
  }

  void read_size(CameraIntrinsics& camera) const {
    static const std::array<std::string, 3> kWidth = {"image_width", "image_Width", "width"};
    static const std::array<std::string, 3> kHeight = {"image_height", "image_Height", "height"};
    static const std::string kBoth = "cameraResolution";  // opencv_interactive-calibration's
    if (key_of(kWidth).empty() && key_of(kHeight).empty() && !at(kBoth).is_null())
      return read_both(kBoth, camera);
    const std::string width = needed_key(kWidth);
    const std::string height = needed_key(kHeight);
    camera.width_px = whole(at(width), width);
    camera.height_px = whole(at(height), height);
  }

  void read_both(const std::string& key, CameraIntrinsics& camera) const {
    const Json& both = at(key);
    if (!both.is_array() || both.size() != 2) throw fault_of(key, text_of(both), "", "width and height");
    camera.width_px = whole(both[0], key + "[0]");
    camera.height_px = whole(both[1], key + "[1]");
  }

  /// That the pictures are all pixels of the sensor that was calibrated, as ROS' drivers may say that they are not.
  void check_part(const CameraIntrinsics& camera) const {
    for (const std::string key : {"binning_x", "binning_y"}) {
      if (!at(key).is_null() && at(key) != 0 && at(key) != 1)
        throw fault_of(key, text_of(at(key)), "", "0 or 1: binned pictures are not supported");
    }
    const Json& roi = at("roi");
    if (!roi.is_object()) return;
    const std::array<std::pair<const char*, int>, 4> whole_picture = {
        {{"x_offset", 0}, {"y_offset", 0}, {"width", camera.width_px}, {"height", camera.height_px}}};
    for (const auto& [key, size_px] : whole_picture) {
      const Json value = roi.value(key, Json(0));
      if (value != 0 && value != size_px)
        throw fault_of(fmt::format("roi.{}", key), text_of(value), "px",
                       "0: parts of pictures are not supported");
    }
  }

  /// As Kalibr's camchain has it.
  void read_kalibr(Calibration& found) const {
    static const std::array<std::string, 5> kKeys = {"camera_model", "distortion_model", "resolution",
                                                     "intrinsics", "distortion_coeffs"};
    for (const std::string& key : kKeys) (void)needed_key({&key, 1});
    read_both("resolution", found.camera);
    const std::vector<double> values = numbers("intrinsics", 4, "fx, fy, cx and cy");
    set_pinhole(found.camera, values[0], values[1], values[2], values[3]);
    const std::vector<double> lens = numbers("distortion_coeffs", 4, "k1, k2, p1 and p2");
    found.lens = {.k1 = lens[0], .k2 = lens[1], .p1 = lens[2], .p2 = lens[3]};
  }

  [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t count,
                                            std::string_view rule) const {
    const Json& list = at(key);
    if (!list.is_array() || list.size() != count) throw fault_of(key, text_of(list), "", rule);
    std::vector<double> values;
    for (const Json& value : list) values.push_back(number(value, entry_of(key, values.size())));
    return values;
  }

  static void set_pinhole(CameraIntrinsics& camera, double fx_px, double fy_px, double cx_px, double cy_px) {
    constexpr double kFirstCentrePx = 0.5;  // of the top left pixel; the files' is 0
    camera.fx_px = fx_px;
    camera.fy_px = fy_px;
    camera.cx_px = cx_px + kFirstCentrePx;
    camera.cy_px = cy_px + kFirstCentrePx;
  }

  void read_camera_matrix(CameraIntrinsics& camera) const {
    static const std::array<std::string, 5> kKeys = {"camera_matrix", "cameraMatrix", "Camera_Matrix", "K",
                                                     "k"};
    const std::string key = needed_key(kKeys);
    const std::vector<double> values = matrix(key, 3, 3);
    constexpr std::array<double, 9> kFixed = {kNothing, 0, kNothing, 0, kNothing, kNothing, 0, 0, 1};
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isnan(kFixed[i]) || values[i] == kFixed[i]) continue;
      throw fault_of(entry_of(key, i), fmt::format("{}", values[i]), "",
                     fmt::format("{}{}", kFixed[i], i == 1 ? ": skewed pixels are not supported" : ""));
    }
    set_pinhole(camera, values[0], values[4], values[2], values[5]);
  }

  void read_distortion(LensDistortion& lens) const {
    static const std::array<std::string, 5> kKeys = {"distortion_coefficients", "dist_coeffs",
                                                     "Distortion_Coefficients", "D", "d"};
    const std::string key = needed_key(kKeys);
    std::vector<double> values = matrix(key);
    const std::size_t count = values.size();
    if (count != 4 && count != 5 && count != 8 && count != 12 && count != 14)
      throw fault_of(key, fmt::format("{} numbers", count), "", "4, 5, 8, 12 or 14, in OpenCV's order");
    values.resize(kModelled + kUnmodelled.size());
    for (std::size_t i = 0; i < kUnmodelled.size(); ++i) {
      const auto& [coefficient, model] = kUnmodelled.at(i);
      if (values[kModelled + i] == 0) continue;
      throw fault_of(fmt::format("{}: {}", key, coefficient), fmt::format("{}", values[kModelled + i]), "",
                     fmt::format("0: the {} model is not supported", model));
    }
    lens = {.k1 = values[0], .k2 = values[1], .p1 = values[2], .p2 = values[3], .k3 = values[4]};
  }

  /// The numbers of a matrix, row by row; one row or column where its shape is not given. A message of ROS has the
  /// numbers alone.
  [[nodiscard]] std::vector<double> matrix(const std::string& key, std::size_t rows = 0,
                                           std::size_t columns = 0) const {
    const Json& node = at(key);
    const bool is_bare = node.is_array() && key.size() == 1;
    if (!is_bare && (!node.is_object() || !node.contains("data") || !node["data"].is_array()))
      throw fault_of(key, text_of(node), "", "rows, cols and data, a list of numbers");
    if (!is_bare) check_shape(node, key, rows, columns);
    const Json& data = is_bare ? node : node["data"];
    if (is_bare && rows > 0 && data.size() != rows * columns)
      throw fault_of(key, fmt::format("{} numbers", data.size()), "", fmt::format("{}", rows * columns));
    std::vector<double> values;
    for (const Json& value : data) values.push_back(number(value, entry_of(key, values.size())));
    return values;
  }

  void check_shape(const Json& node, const std::string& key, std::size_t rows, std::size_t columns) const {
    const auto found_rows = static_cast<std::size_t>(whole(node.value("rows", Json()), key + ".rows"));
    const auto found_columns = static_cast<std::size_t>(whole(node.value("cols", Json()), key + ".cols"));
    const bool fits =
        rows == 0 ? found_rows == 1 || found_columns == 1 : found_rows == rows && found_columns == columns;
    if (!fits) {
      throw fault_of(key, fmt::format("{} x {}", found_rows, found_columns), "",
                     rows == 0 ? "one row or column" : fmt::format("{} x {}", rows, columns));
    }
    if (const std::size_t size = node["data"].size(); size != found_rows * found_columns) {
      throw fault_of(key + ".data", fmt::format("{} numbers", size), "",
                     fmt::format("{}", found_rows * found_columns));
    }
  }

  [[nodiscard]] std::string entry_of(const std::string& key, std::size_t place) const {
    return fmt::format("{}{}[{}]", key, at(key).is_object() ? ".data" : "", place);
  }

  [[nodiscard]] double number(const Json& node, const std::string& where) const {
    const double value = node.is_number() ? node.get<double>() : kNothing;
    if (!std::isfinite(value)) throw fault_of(where, text_of(node), "", "a number");
    return value;
  }

  [[nodiscard]] int whole(const Json& node, const std::string& where) const {
    const double value = node.is_null() ? kNothing : number(node, where);
    constexpr int kLargest = 100000;
    if (value >= 1 && value <= kLargest && value == std::floor(value)) return static_cast<int>(value);
    throw fault_of(where, text_of(node), "", fmt::format("a whole number from 1 to {}", kLargest));
  }

  [[nodiscard]] static std::string text_of(const Json& node) {
    if (node.is_null()) return "nothing";
    if (node.is_number_float()) {
      const auto value = node.get<double>();
      return std::isnan(value) ? "nan" : fmt::format("{}", value);
    }
    constexpr std::size_t kMost = 60;
    if (node.is_string()) return printable(node.get<std::string>().substr(0, kMost));
    if (node.is_array()) return fmt::format("a list of {}", node.size());
    return node.is_object() ? "keys" : node.dump();
  }

  const Json& root_;
  const std::string& name_;
  std::string prefix_;
};

}  // namespace

Calibration read_calibration(const Path& file) {
  check_is_file(file);
  std::string text;
  read_pieces(file, [&](std::string_view piece) {
    if (text.size() <= kMostCalibrationBytes) text.append(piece);
  });
  return parse_calibration(text, file.string());
}

Calibration parse_calibration(std::string_view text, const std::string& name) {
  return Reader(calibration_tree(text, name), name).read();
}

}  // namespace thermal
