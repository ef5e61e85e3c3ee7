#include "io/versions.h"

#include <OpenEXRConfig.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <isa-l.h>
#include <nlohmann/json.hpp>
#include <oneapi/tbb/version.h>
#include <opencv2/core/utility.hpp>
#include <openssl/crypto.h>

extern "C" {
#include <libavutil/avutil.h>
}

namespace thermal {

std::vector<std::pair<std::string, std::string>> library_versions() {
  const int oiio = OIIO::openimageio_version();
  return {{"OpenEXR", OPENEXR_VERSION_STRING},
          {"OpenImageIO", fmt::format("{}.{}.{}", oiio / 10000, oiio / 100 % 100, oiio % 100)},
          {"OpenCV", cv::getVersionString()},
          {"ISA-L", fmt::format("{}.{}.{}", ISAL_MAJOR_VERSION, ISAL_MINOR_VERSION, ISAL_PATCH_VERSION)},
          {"FFmpeg", av_version_info()},
          {"oneTBB", TBB_runtime_version()},
          {"OpenSSL", OpenSSL_version(OPENSSL_VERSION_STRING)},
          {"nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                        NLOHMANN_JSON_VERSION_PATCH)}};
}

}  // namespace thermal
