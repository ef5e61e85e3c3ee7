#pragma once

#include <cstdint>
#include <string>

namespace cv {
class Mat;
}

namespace thermal {

/// File formats of stills, and of pictures in reports.
enum class PictureFormat : std::uint8_t { png, jpeg };

/// The bytes of a picture file: PNG at its highest compression, or JPEG at quality 92.
/// @param bgr  8 bits, three channels, OpenCV's order
[[nodiscard]] std::string encode_picture(const cv::Mat& bgr, PictureFormat format);

}  // namespace thermal
