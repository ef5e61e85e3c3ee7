#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "dataset/clip/annotations.h"
#include "dataset/clip/imager.h"
#include "dataset/clip/record.h"
#include "dataset/clip/task.h"
#include "io/image/png.h"
#include "io/system/files.h"
#include "io/system/sha256.h"
#include "io/video/preview_video.h"

namespace thermal {

/// One task's clip while it is made: its camera and its files, in the task's folder. A frame of its scene
/// goes through expose, encode, write and collect; different frames may be written at the same time, the others must be
/// called one by one and in order.
class ClipOutput {
 public:
  /// Checksums of one written picture: of its pixels and of its file.
  struct WrittenPicture {
    std::string pixels_sha256;
    std::string file_sha256;
  };
  /// A frame in flight. Its memory is reused.
  struct Frame : ClipImager::Frame {
    WrittenPicture ir8;
    WrittenPicture ir16;
    std::vector<std::byte> png;
  };

  /// Creates the task's folder, or empties it. `task` and `manifest` must outlive this object.
  /// @param brightest_w_m2_sr  of the task's scene: FrameConverter::brightest_w_m2_sr()
  /// @param temperatures  for its camera; see ThermalCamera
  ClipOutput(const ClipTask& task, const Manifest& manifest, float brightest_w_m2_sr,
             std::shared_ptr<const TemperatureTable> temperatures);

  /// As ClipImager's.
  void expose(const SceneFrame& scene, Frame& frame) { imager_.expose(scene, frame); }
  void encode(Frame& frame) { imager_.encode(frame); }
  void write(int number, Frame& frame) const;
  void collect(int number, const Frame& frame);

  /// Replaces expose() for a frame that could not be read or converted: the clip continues without it. Its number
  /// stays unused in file names, labels and frames.jsonl; clip.json lists it.
  void skip(int number, const std::string& reason);

  /// Writes the files of the clip as a whole.
  ClipRecord finish();

 private:
  [[nodiscard]] const ManifestFrame& frame_of(int number) const;
  [[nodiscard]] Json frame_line(int number, const Frame& frame) const;
  void write_labels();

  const ClipTask& task_;
  const Manifest& manifest_;
  Path folder_;
  float brightest_w_m2_sr_;
  ClipImager imager_;
  PreviewVideo video_;
  ClipAnnotations annotations_;
  Sha256 pixels_;
  ClipRecord record_;
  PassChecks checks_;  ///< of all frames made
  OutputFile frames_jsonl_;
};

}  // namespace thermal
