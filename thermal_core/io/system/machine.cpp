#include "io/system/machine.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <thread>

#include <OpenEXRConfig.h>
#include <fmt/format.h>
#include <isa-l.h>
#include <nlohmann/json.hpp>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/version.h>
#include <opencv2/core/utility.hpp>
#include <openssl/crypto.h>

#include "base/error.h"
#include "base/text.h"
#include "io/image/picture_module.h"
#include "io/system/text_file.h"
#include "io/video/video_codec.h"

extern "C" {
#include <libavutil/avutil.h>
}

namespace thermal {
namespace {

/// A whole number of 1 or more; otherwise 0.
double positive(std::string_view text) {
  long long number = 0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && last == end && number > 0 ? static_cast<double>(number) : 0;
}

/// Content of a small file; empty if it cannot be read.
std::string content_of(const Path& file) {
  constexpr std::size_t kMostContentBytes = 64 << 10;
  try {
    return read_text_file(file, kMostContentBytes);
  } catch (const IoError&) {
    return "";
  }
}

std::optional<double> limit_in(const Path& group, int version) {
  return cpu_limit(version == 2 ? content_of(group / "cpu.max")
                                : content_of(group / "cpu.cfs_quota_us") + " " +
                                      content_of(group / "cpu.cfs_period_us"));
}

bool is_cpu_in(std::string_view controllers) {
  return fmt::format(",{},", controllers).find(",cpu,") != std::string::npos;
}

}  // namespace

std::optional<double> cpu_limit(std::string_view quota_and_period) {
  std::istringstream words{std::string(quota_and_period)};
  std::string quota;
  std::string period;
  std::string more;
  words >> quota >> period;
  if (words >> more || positive(quota) == 0 || positive(period) == 0) return std::nullopt;
  return positive(quota) / positive(period);
}

std::vector<CpuGroup> cpu_groups(std::string_view content) {
  std::vector<CpuGroup> groups;
  std::istringstream lines{std::string(content)};
  // NUMBER:CONTROLLERS:PATH, and 0::PATH for version 2
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(":/", first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (!controllers.empty() && !is_cpu_in(controllers)) continue;
    const Path path = Path(line.substr(second + 1)).lexically_normal();  // above a container: "/../other"
    groups.push_back({.version = controllers.empty() ? 2 : 1, .path = path.relative_path()});
  }
  return groups;
}

std::optional<double> smallest_cpu_limit(const Path& root) {
  const Path mounts = root / "sys/fs/cgroup";
  std::optional<double> smallest;
  const auto check_group = [&smallest](const Path& group, int version) {
    const std::optional<double> limit = limit_in(group, version);
    if (limit) smallest = std::min(*limit, smallest.value_or(*limit));
  };
  for (const CpuGroup& group : cpu_groups(content_of(root / "proc/self/cgroup"))) {
    const Path mount = group.version == 2 ? mounts : mounts / "cpu";
    // In a container, the path may be that on the host, and the container's own group is the mount.
    for (Path path = group.path; !path.empty(); path = path.parent_path())
      check_group(mount / path, group.version);
    check_group(mount, group.version);
  }
  return smallest;
}

int Cores::usable() const noexcept {
  const double most = limit ? std::min<double>(std::ceil(*limit), affinity) : affinity;
  return std::max(1, static_cast<int>(most));
}

Cores find_cores() {
  const int affinity = tbb::info::default_concurrency();
  const int online = static_cast<int>(std::thread::hardware_concurrency());
  return {.machine = std::max(online, affinity), .affinity = affinity, .limit = smallest_cpu_limit()};
}

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
