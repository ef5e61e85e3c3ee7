#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "support/exr.h"

/// Passes of a small clip: a person and an elephant walk over soil and grass, the person out of the frame.
namespace tiny_clip {

inline constexpr int kWidth = 40;
inline constexpr int kHeight = 30;
inline constexpr int kFrames = 3;
inline constexpr int kHuman = 5;
inline constexpr int kElephant = 6;

inline std::string file_name(int frame) { return "00000" + std::to_string(frame) + ".exr"; }

/// Index planes of a frame: an elephant of 10 x 8 px moving right, a person of 2 x 4 px leaving to the left, out of
/// the frame by the third.
inline ExrChannels planes(int frame) {
  std::vector<float> objects(kWidth * kHeight, 1);
  std::vector<float> materials(kWidth * kHeight, 0);
  const auto fill = [](std::vector<float>& plane, float value, int left, int top, int right, int bottom) {
    for (int y = top; y < bottom; ++y) {
      for (int x = std::max(0, left); x < right; ++x) plane[static_cast<std::size_t>(y * kWidth + x)] = value;
    }
  };
  fill(materials, 2, 20, 0, kWidth, kHeight);
  fill(objects, kElephant, 12 + 2 * frame, 10, 22 + 2 * frame, 18);
  fill(materials, 0, 12 + 2 * frame, 10, 22 + 2 * frame, 18);
  fill(objects, kHuman, 1 - 2 * frame, 20, 3 - 2 * frame, 24);
  return {{"Scene.IndexOB.X", objects}, {"Scene.IndexMA.X", materials}};
}

inline nlohmann::ordered_json manifest(const std::string& clip) {
  nlohmann::ordered_json frames = nlohmann::ordered_json::array();
  for (int i = 0; i < kFrames; ++i)
    frames.push_back({{"file", file_name(i)}, {"time_s", 0.2 * i}, {"agl_m", 61}});
  return {{"format", "veldt-passes"},
          {"version", 1},
          {"clip", clip},
          {"frame_rate_hz", 5},
          {"camera",
           {{"width_px", kWidth},
            {"height_px", kHeight},
            {"fx_px", 50},
            {"fy_px", 50},
            {"cx_px", 20},
            {"cy_px", 15}}},
          {"objects",
           {{{"index", 1}, {"name", "ground"}, {"class", "ground"}, {"material", "soil"}},
            {{"index", kHuman},
             {"name", "anna"},
             {"class", "actor"},
             {"material", "human"},
             {"category", "human"},
             {"track_id", 11}},
            {{"index", kElephant},
             {"name", "ella"},
             {"class", "actor"},
             {"material", "elephant"},
             {"category", "elephant"},
             {"track_id", 12}}}},
          {"materials", {{{"index", 2}, {"material", "grass"}}}},
          {"frames", frames}};
}

/// Writes a clip's folder and returns it.
inline std::filesystem::path write(const std::filesystem::path& folder, const std::string& clip) {
  std::filesystem::create_directories(folder / clip);
  for (int i = 0; i < kFrames; ++i) write_exr(folder / clip / file_name(i), kWidth, kHeight, planes(i));
  std::ofstream(folder / clip / "manifest.json") << manifest(clip).dump(2);
  return folder / clip;
}

}  // namespace tiny_clip
