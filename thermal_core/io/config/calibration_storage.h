#pragma once

#include <cstddef>
#include <exception>
#include <string>
#include <string_view>

#include <opencv2/core.hpp>

#include "base/error.h"

namespace thermal {

/// OpenCV's parsers read past the end of texts that are cut off, among others. So a calibration is read by them only if it
/// keeps to the part of XML or YAML that OpenCV and ROS write: these throw ConfigError "NAME:LINE: expected …" where it
/// does not. Text in the numbers' places is left to the reader.

/// <?xml …?>, one <opencv_storage>, in it tags of one name and at most a type_id that end in order, up to 16 deep;
/// words, numbers and strings without < > & ", and comments.
void check_xml(std::string_view text, const std::string& name);

/// `key: value`, `key: !!opencv-matrix`, `key:` and `- value`, values being words, numbers, strings in quotes, and lists in
/// [ ] over one line or more; comments; %YAML and --- before everything.
void check_yaml(std::string_view text, const std::string& name);

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
