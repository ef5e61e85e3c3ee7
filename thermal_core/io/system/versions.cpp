#include "io/system/versions.h"

#include <OpenEXRConfig.h>
#include <fmt/format.h>
#include <isa-l.h>
#include <nlohmann/json.hpp>
#include <oneapi/tbb/version.h>
#include <opencv2/core/utility.hpp>
#include <openssl/crypto.h>

extern "C" {
#include <libavutil/avutil.h>
}

#include "base/text.h"
#include "io/image/picture_module.h"
#include "io/video/video_codec.h"

namespace thermal {
namespace {

/// FFmpeg's version, and the values of `output.codec` that it supports.
std::string ffmpeg_with_codecs() {
  const std::vector<std::string> codecs = installed_video_codecs();
  return fmt::format("{}, output.codec: {}", av_version_info(), codecs.empty() ? "none" : list_names(codecs));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> library_versions() {
  return {{"OpenEXR", OPENEXR_VERSION_STRING},
          {"OpenImageIO", picture_module().openimageio_version()},
          {"OpenCV", cv::getVersionString()},
          {"ISA-L", fmt::format("{}.{}.{}", ISAL_MAJOR_VERSION, ISAL_MINOR_VERSION, ISAL_PATCH_VERSION)},
          {"FFmpeg", ffmpeg_with_codecs()},
          {"oneTBB", TBB_runtime_version()},
          {"OpenSSL", OpenSSL_version(OPENSSL_VERSION_STRING)},
          {"nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                        NLOHMANN_JSON_VERSION_PATCH)}};
}

}  // namespace thermal
