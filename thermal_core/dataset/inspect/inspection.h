#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/clip/pass_folders.h"
#include "dataset/inspect/survey.h"
#include "dataset/progress.h"
#include "io/assets.h"
#include "io/exr/header.h"
#include "io/json/file.h"
#include "scene/manifest.h"

namespace thermal {

/// Options of an inspection.
struct InspectOptions {
  Assets assets;
  std::vector<Path> passes;  ///< a folder, or files and patterns of one folder
  Path manifest;             ///< empty: the folder's, if any
  std::string layer;         ///< empty: the manifest's
  bool all_frames = false;   ///< read the pixels of every frame, not only of the first
  bool for_starter = false;  ///< ignore any manifest, and accept the only likely index plane
  ReadLimits limits;
};

/// Contents of passes, and how a conversion would use them.
struct Inspection {
  PassesGroup group;
  FrameSequence sequence;            ///< gaps: frames without a file
  Path file;                         ///< the first existing one: headers are described for it
  std::optional<Manifest> manifest;  ///< given, or in the folder
  ExrLayout layout;                  ///< determines which planes are chosen
  ExrHeader header;                  ///< of a picture (PNG) only the size
  std::optional<ExrWindow> window;   ///< with pixels, where it is not the whole picture
  std::vector<std::string> cryptomatte_faults;
  PassSurvey survey;
  ChosenPlanes planes;              ///< empty if the conversion has no object index
  std::string cryptomatte;          ///< read by a conversion instead of an object index
  std::string obstacle;             ///< why these passes cannot be converted; empty if they can
  std::vector<std::string> layers;  ///< candidates to choose from; empty: unambiguous
  std::vector<std::string> likely;  ///< channels that could be an object index despite their names
};

/// Inspects passes; reports faults of their contents instead of throwing. ConfigError for names that match no files,
/// or files of several folders; IoError if the first file cannot be read; DataError for an invalid manifest. Progress
/// counts frames.
[[nodiscard]] Inspection inspect(const InspectOptions& options, const RunHooks& hooks);

/// The complete inspection as JSON.
[[nodiscard]] Json to_json(const Inspection& inspection);

/// Name of an object index; empty: unknown.
[[nodiscard]] std::string object_name(const Inspection& inspection, int index);

}  // namespace thermal
