#include "io/config/calibration_file.h"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "io/config/calibration_storage.h"

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

/// The parts of one file, by the names in use for them.
class Reader {
 public:
  Reader(const cv::FileStorage& storage, const std::string& name) : root_(storage.root()), name_(name) {}

  [[nodiscard]] Calibration read() const {
    check_kind();
    Calibration found;
    read_size(found.camera);
    read_camera_matrix(found.camera);
    read_distortion(found.lens);
    return found;
  }

 private:
  [[nodiscard]] ConfigError fault_of(std::string_view where, std::string_view value, std::string_view unit,
                                     std::string_view rule) const {
    return ConfigError(name_ + ": " + fault(where, value, unit, rule));
  }

  /// The first key of these that is there; empty if none is.
  [[nodiscard]] std::string key_of(std::span<const std::string> keys) const {
    for (const std::string& key : keys) {
      if (!root_[key].empty()) return key;
    }
    return "";
  }

  [[nodiscard]] std::string needed_key(std::span<const std::string> keys) const {
    std::string key = key_of(keys);
    if (key.empty()) {
      throw ConfigError(fmt::format("{}: {} is missing; expected {}", name_, keys.front(),
                                    keys.size() == 1 ? "it to be given" : "one of " + list_names(keys)));
    }
    return key;
  }

  /// That the file is about one camera, of a kind that there is a model for.
  void check_kind() const {
    if (!root_.isMap()) throw ConfigError(name_ + ": no keys; expected some, such as camera_matrix");
    if (!root_["M1"].empty()) {
      throw ConfigError(
          name_ +
          ": M1 is a stereo calibration's, which does not say for what size of picture; expected "
          "image_width, image_height, camera_matrix and distortion_coefficients of one camera");
    }
    const cv::FileNode fisheye = root_["fisheye_model"];
    if (!fisheye.empty() && !(fisheye.isInt() && static_cast<int>(fisheye) == 0))
      throw fault_of("fisheye_model", text_of(fisheye), "", "0: fisheye lenses are not supported");
    const cv::FileNode model = root_["distortion_model"];
    if (!model.empty() && text_of(model) != "plumb_bob" && text_of(model) != "rational_polynomial") {
      throw fault_of("distortion_model", text_of(model), "",
                     "plumb_bob, or rational_polynomial whose k4 to k6 are 0");
    }
    check_rectification();
  }

  void check_rectification() const {
    const std::string key = "rectification_matrix";
    if (root_[key].empty()) return;
    const std::vector<double> values = matrix(key, 3, 3);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double expected = i % 4 == 0 ? 1 : 0;
      if (values[i] == expected) continue;
      throw fault_of(fmt::format("{}.data[{}]", key, i), fmt::format("{}", values[i]), "",
                     fmt::format("{}: of a stereo pair's camera the raw picture is made, so leave {} out",
                                 expected, key));
    }
  }

  void read_size(CameraIntrinsics& camera) const {
    static const std::array<std::string, 2> kWidth = {"image_width", "image_Width"};
    static const std::array<std::string, 2> kHeight = {"image_height", "image_Height"};
    static const std::string kBoth = "cameraResolution";  // opencv_interactive-calibration's
    if (key_of(kWidth).empty() && key_of(kHeight).empty() && !root_[kBoth].empty()) {
      const cv::FileNode both = root_[kBoth];
      if (!both.isSeq() || both.size() != 2) throw fault_of(kBoth, text_of(both), "", "width and height");
      camera.width_px = whole(both[0], kBoth + "[0]");
      camera.height_px = whole(both[1], kBoth + "[1]");
      return;
    }
    const std::string width = needed_key(kWidth);
    const std::string height = needed_key(kHeight);
    camera.width_px = whole(root_[width], width);
    camera.height_px = whole(root_[height], height);
  }

  void read_camera_matrix(CameraIntrinsics& camera) const {
    static const std::array<std::string, 3> kKeys = {"camera_matrix", "cameraMatrix", "Camera_Matrix"};
    const std::string key = needed_key(kKeys);
    const std::vector<double> values = matrix(key, 3, 3);
    constexpr std::array<double, 9> kFixed = {kNothing, 0, kNothing, 0, kNothing, kNothing, 0, 0, 1};
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isnan(kFixed[i]) || values[i] == kFixed[i]) continue;
      throw fault_of(fmt::format("{}.data[{}]", key, i), fmt::format("{}", values[i]), "",
                     fmt::format("{}{}", kFixed[i], i == 1 ? ": skewed pixels are not supported" : ""));
    }
    constexpr double kFirstCentrePx = 0.5;  // of the top left pixel; OpenCV's is 0
    camera.fx_px = values[0];
    camera.fy_px = values[4];
    camera.cx_px = values[2] + kFirstCentrePx;
    camera.cy_px = values[5] + kFirstCentrePx;
  }

  void read_distortion(LensDistortion& lens) const {
    static const std::array<std::string, 3> kKeys = {"distortion_coefficients", "dist_coeffs",
                                                     "Distortion_Coefficients"};
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

  /// The numbers of a matrix, row by row; one row or column where its shape is not given.
  [[nodiscard]] std::vector<double> matrix(const std::string& key, int rows = 0, int columns = 0) const {
    const cv::FileNode node = root_[key];
    if (!node.isMap() || !node["data"].isSeq())
      throw fault_of(key, text_of(node), "", "rows, cols and data, a list of numbers");
    const int found_rows = whole(node["rows"], key + ".rows");
    const int found_columns = whole(node["cols"], key + ".cols");
    const bool fits =
        rows == 0 ? found_rows == 1 || found_columns == 1 : found_rows == rows && found_columns == columns;
    if (!fits) {
      throw fault_of(key, fmt::format("{} x {}", found_rows, found_columns), "",
                     rows == 0 ? "one row or column" : fmt::format("{} x {}", rows, columns));
    }
    const cv::FileNode data = node["data"];
    const auto size = static_cast<std::int64_t>(data.size());
    if (size != std::int64_t{found_rows} * found_columns) {
      throw fault_of(key + ".data", fmt::format("{} numbers", size), "",
                     fmt::format("{}", std::int64_t{found_rows} * found_columns));
    }
    std::vector<double> values;
    for (const cv::FileNode& value : data)
      values.push_back(number(value, fmt::format("{}.data[{}]", key, values.size())));
    return values;
  }

  [[nodiscard]] double number(const cv::FileNode& node, const std::string& where) const {
    const bool is_number = node.isInt() || node.isReal();
    const double value = is_number ? static_cast<double>(node) : kNothing;
    if (!std::isfinite(value)) throw fault_of(where, text_of(node), "", "a number");
    return value;
  }

  [[nodiscard]] int whole(const cv::FileNode& node, const std::string& where) const {
    const double value = node.empty() ? kNothing : number(node, where);
    constexpr int kLargest = 100000;
    if (value >= 1 && value <= kLargest && value == std::floor(value)) return static_cast<int>(value);
    throw fault_of(where, text_of(node), "", fmt::format("a whole number from 1 to {}", kLargest));
  }

  [[nodiscard]] static std::string text_of(const cv::FileNode& node) {
    if (node.empty()) return "nothing";
    if (node.isInt()) return fmt::format("{}", static_cast<int>(node));
    if (node.isReal()) {
      const auto value = static_cast<double>(node);
      return std::isnan(value) ? "nan" : fmt::format("{}", value);
    }
    constexpr std::size_t kMost = 60;
    if (node.isString()) return static_cast<std::string>(node).substr(0, kMost);
    return node.isMap() ? "keys" : fmt::format("a list of {}", node.size());
  }

  cv::FileNode root_;
  const std::string& name_;
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
  const QuietOpenCv quiet;
  try {
    const cv::FileStorage storage = open_storage(text, name);
    return Reader(storage, name).read();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw unreadable(error, name);
  }
}

}  // namespace thermal
