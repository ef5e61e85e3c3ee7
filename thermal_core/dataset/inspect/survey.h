#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/exr/cryptomatte.h"
#include "io/exr/header.h"
#include "io/exr/passes.h"
#include "io/image/index_picture.h"
#include "io/pass_reader.h"

namespace thermal {

/// Channels that a conversion would read; empty: missing.
struct ChosenPlanes {
  std::string objects;
  std::string materials;
  std::string depth;
  std::string normals;  ///< of one axis
};

/// Contents of a clip's passes, counted over the pixels of all frames read.
struct PassSurvey {
  /// A cryptomatte's entry.
  struct Matte {
    std::string name;  ///< empty: the file does not name it
    std::int64_t pixels = 0;
  };
  /// Range of usable depths.
  struct DepthRange {
    float nearest_m = 0;
    float farthest_m = 0;
  };
  /// A frame that cannot be read, and why.
  struct BadFrame {
    std::string file;
    std::string reason;
  };

  int frames = 0;
  std::map<int, std::int64_t> objects;  ///< pixels by index
  std::map<int, std::int64_t> materials;
  std::map<Colour, std::int64_t> colours;  ///< of coloured pictures
  std::map<std::string, std::map<std::uint32_t, Matte>>
      cryptomattes;                   ///< by name, then hash; pixels of rank 0
  std::optional<DepthRange> depth;    ///< without sky
  std::int64_t uncounted_pixels = 0;  ///< transparent, or beyond the limit of colours or mattes
  std::vector<BadFrame> bad_frames;   ///< unreadable ones
};

/// Counts the pixels of frames. Everything readable is counted; unreadable frames are listed as bad.
class PassSurveyor {
 public:
  PassSurveyor(ExrLayout layout, ReadLimits limits);

  void add(const Path& file);
  [[nodiscard]] const PassSurvey& found() const noexcept { return survey_; }

 private:
  void add_picture(const Path& file);
  void add_exr(const Path& file);
  void add_planes(const Path& file, const ExrHeader& header);
  void add_mattes(const Path& file, const ExrHeader& header);
  void add_lower_ranks(const Path& file, const ExrHeader& header, const Cryptomatte& cryptomatte);
  void add_depth(const Plane<float>& depth_m);

  ExrLayout layout_;
  ReadLimits limits_;
  PassSurvey survey_;
};

/// Chooses the channels of a file. DataError if it has no object index, or several and none is chosen.
[[nodiscard]] ChosenPlanes choose_planes(const ExrHeader& header, const ExrLayout& layout);

/// Channels in which every pixel could be an index and not all are equal: those that are neither a colour nor a known pass,
/// then the reds of pictures with three equal colours, as some renderers write an index. Full names, in the file's order.
[[nodiscard]] std::vector<std::string> likely_indices(const Path& file, const ExrHeader& header,
                                                      const ReadLimits& limits);

}  // namespace thermal
