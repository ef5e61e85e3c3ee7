#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "dataset/dataset_file.h"
#include "labels/label_set.h"
#include "sensor/agc.h"

namespace thermal {

/// The properties of a dataset that videos use.
struct FilmedDataset {
  Layout layout;
  std::string name;
  std::string camera;                              ///< the sensor's preset, or its model where there is none
  std::map<std::string, std::string> own_cameras;  ///< of clips that have another, by id
  double kelvin_per_count = 0;
  std::vector<std::string> clips;  ///< all ids
  std::vector<std::string> made;   ///< finished ones

  [[nodiscard]] const std::string& camera_of(const std::string& clip) const;

  /// ConfigError "--clips = …" for an unknown id, DataError for a clip that is not finished.
  void check_clips(const std::vector<std::string>& ids) const;
};

/// Reads dataset.json. IoError if `root` is not a dataset, DataError if its record is damaged.
[[nodiscard]] FilmedDataset read_filmed_dataset(const Path& root);

/// A frame's entry of frames.jsonl.
struct FilmFrame {
  int frame_index = 0;
  double time_s = 0;
  std::optional<double> agl_m;
  std::optional<std::array<double, 16>> camera_to_world;  ///< row by row
  bool shutter_closed = false;
  std::optional<std::array<std::uint16_t, kLevels - 1>>
      thresholds;  ///< see ToneCurve; empty: the curve is local
};

/// The camera of a clip's labels, with the coefficients of its lens in OpenCV's order: k1, k2, p1, p2, k3, k4, k5, k6.
struct FilmCamera {
  double fx_px = 0;
  double fy_px = 0;
  double cx_px = 0;
  double cy_px = 0;
  std::array<double, 8> distortion{};
};

/// One finished clip; frames are read one by one.
struct ClipFilm {
  Path folder;
  std::string id;
  double frame_rate_hz = 0;
  int width_px = 0;
  int height_px = 0;
  bool black_hot = false;
  std::string agc_mode;
  std::vector<FilmFrame> frames;
  LabelSet labels;                       ///< empty unless requested
  std::vector<std::size_t> first_label;  ///< of each of `frames`, in `labels`; and the number of labels
  std::optional<FilmCamera> camera;      ///< where labels.json has it

  /// The 8-bit frame as white-hot levels.
  [[nodiscard]] Plane<std::uint8_t> read_levels(std::size_t frame) const;
  /// The 16-bit frame.
  [[nodiscard]] Plane<std::uint16_t> read_counts(std::size_t frame) const;
};

/// Reads a clip's records, and its labels.json if `labels`. DataError or IoError naming the file.
[[nodiscard]] ClipFilm read_clip_film(const FilmedDataset& dataset, const std::string& id, bool labels);

/// Selected clips of a dataset.
struct ClipSource {
  FilmedDataset dataset;
  std::vector<std::string> clips;  ///< ids, in the dataset's order or in the requested one; at least one
  bool chosen = false;             ///< by their ids, or by the path of a clip's folder

  /// Clips left out because they are not finished; none if clips were chosen.
  [[nodiscard]] std::vector<std::string> not_made() const;
};

/// `path`: a dataset, or a clip's folder in one (DIR/clips/CLIP). `ids`: clips of the dataset; none: all that are
/// finished. ConfigError "--clips = …" for unknown ids, or for ids together with a clip's folder; DataError if a
/// requested clip, or every clip, is unfinished; errors of read_filmed_dataset().
[[nodiscard]] ClipSource find_clip_source(const Path& path, const std::vector<std::string>& ids);

}  // namespace thermal
