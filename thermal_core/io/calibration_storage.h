#pragma once

#include <cstddef>
#include <exception>
#include <string>
#include <string_view>

#include <opencv2/core.hpp>

#include "base/error.h"

namespace thermal {

inline constexpr std::size_t kMostCalibrationBytes = std::size_t{1} << 20;

/// OpenCV's reader over an untrusted text: its YAML, XML or JSON, or YAML without a header, as ROS writes it.
/// OpenCV's parser calls itself for each level of nesting, without a limit; so the text is first checked by us: its size,
/// no control characters, nothing in base64, and fewer brackets, tags and keys than the stack has room for.
/// ConfigError "NAME: …", also for what OpenCV throws.
[[nodiscard]] cv::FileStorage open_storage(std::string_view text, const std::string& name);

/// "NAME: …; expected …", in the words of OpenCV, which throws std::length_error, too.
[[nodiscard]] ConfigError unreadable(const std::exception& error, const std::string& name);

/// While one lives, OpenCV's errors are not printed, whatever OPENCV_DUMP_ERRORS says; they are still thrown. Not for two
/// threads at once.
class QuietOpenCv {
 public:
  QuietOpenCv() noexcept;
  ~QuietOpenCv();
  QuietOpenCv(const QuietOpenCv&) = delete;
  QuietOpenCv& operator=(const QuietOpenCv&) = delete;

 private:
  void* before_data_ = nullptr;  // above what fills it in
  int (*before_)(int, const char*, const char*, const char*, int, void*);
};

}  // namespace thermal
