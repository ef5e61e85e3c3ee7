#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/pass_survey.h"
#include "dataset/passes_groups.h"
#include "dataset/progress.h"
#include "io/json_file.h"
#include "scene/manifest.h"

namespace thermal {

struct InspectOptions {
  Path home;
  std::vector<Path> passes;  ///< a folder, or files and patterns of one folder
  Path manifest;             ///< empty: the folder's, if it has one
  std::string layer;         ///< empty: the manifest's
  bool all_frames = false;   ///< look at the pixels of every frame, not of the first alone
  bool for_starter = false;  ///< as if there were no manifest, and taking the only likely index plane for one
  ReadLimits limits;
};

/// What passes hold, and what a conversion would do with them.
struct Inspection {
  PassesGroup group;
  FrameSequence sequence;            ///< gaps: frames without a file
  Path file;                         ///< the first that is there: what is said of headers is said of it
  std::optional<Manifest> manifest;  ///< that was given or is in the folder
  ExrLayout layout;                  ///< by which planes were chosen
  ExrHeader header;                  ///< of a picture (PNG) the size alone
  std::optional<ExrWindow> window;   ///< that has pixels, where it is not the whole picture
  std::vector<std::string> cryptomatte_faults;
  PassSurvey survey;
  ChosenPlanes planes;              ///< none where the conversion has no object index
  std::string cryptomatte;          ///< that a conversion would read instead of an object index
  std::string obstacle;             ///< why passes like these cannot be converted; empty: they can
  std::vector<std::string> layers;  ///< of which one is to be chosen; empty: that is clear
  std::vector<std::string> likely;  ///< channels that could be an object index where none has a name of one
};

/// Looks at passes; never fails for what is in them, but tells it.
/// ConfigError for names that mean no files, or files of several folders; IoError for a first file that cannot be read; DataError
/// for a manifest that cannot be meant. Progress counts frames.
[[nodiscard]] Inspection inspect(const InspectOptions& options, const RunHooks& hooks);

/// All of it, for programs.
[[nodiscard]] Json to_json(const Inspection& inspection);

/// What an object index is called; empty: nobody says.
[[nodiscard]] std::string object_name(const Inspection& inspection, int index);

}  // namespace thermal
