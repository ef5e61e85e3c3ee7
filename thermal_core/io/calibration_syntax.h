#pragma once

#include <string>
#include <string_view>

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

}  // namespace thermal
