#pragma once

#include <string>

#include "dataset/annotations.h"
#include "dataset/clip_maker.h"
#include "imaging/frame_converter.h"
#include "io/preview_video.h"
#include "io/sha256.h"
#include "sensor/thermal_camera.h"

namespace thermal {

/// One task's clip while it is made: its scene and camera, and its files, in the task's unfinished folder.
/// A frame goes through convert, expose, write and collect; different frames may be in the first and the third at
/// the same time, expose and collect want them one by one and in order.
class ClipOutput {
 public:
  /// One picture as it was written: sums of its pixels and of its file.
  struct WrittenPicture {
    std::string pixels_sha256;
    std::string file_sha256;
  };
  /// A frame on its way. Its memory is used again.
  struct Frame {
    SceneFrame scene;
    SensorFrame pictures;
    WrittenPicture ir8;
    WrittenPicture ir16;
  };

  /// Empties the task's unfinished folder, or makes it. `task` and `manifest` must outlive this.
  ClipOutput(const ClipTask& task, const Manifest& manifest, const MaterialLibrary& materials);

  /// Planes that convert() wants.
  [[nodiscard]] PassNeeds needs() const noexcept { return converter_.needs(); }

  /// DataError without the name of a file.
  void convert(const Passes& passes, int number, Frame& frame) const;
  void expose(Frame& frame);
  void write(int number, Frame& frame) const;
  void collect(int number, const Frame& frame);

  /// Writes what is about the clip as a whole.
  ClipRecord finish();

  /// Renames the finished clip's folder.
  void move_into_place() const;

 private:
  [[nodiscard]] const ManifestFrame& told_of(int number) const;
  [[nodiscard]] Json frame_line(int number, const Frame& frame) const;
  void add_text(const std::string& name, const std::string& text);

  const ClipTask& task_;
  const Manifest& manifest_;
  Path folder_;
  FrameConverter converter_;
  ThermalCamera camera_;
  PreviewVideo video_;
  ClipAnnotations annotations_;
  Sha256 pixels_;
  ClipRecord record_;
  std::string frames_jsonl_;
};

}  // namespace thermal
