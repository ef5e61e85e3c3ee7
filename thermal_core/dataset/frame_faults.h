#pragma once

#include <exception>
#include <string>
#include <vector>

#include "dataset/clip_maker.h"

namespace thermal {

/// Reads a clip's frames within its limits. DataError if its camera's picture, as fine as the passes are, is larger
/// than those: before anything that size is made.
[[nodiscard]] PassReader reader_for(const ClipPasses& passes);

/// Where a frame's planes are. IoError for what is no file, or if the manifest has none for that frame.
[[nodiscard]] Path file_of(const ClipPasses& passes, int frame);

/// A fault's words.
[[nodiscard]] std::string message_of(const std::exception_ptr& fault);

/// The words of a fault of a file, without the file's name that they begin with.
[[nodiscard]] std::string without_name(const std::string& what, const Path& file);

/// What is told of a frame that is skipped for a fault.
[[nodiscard]] SkippedFrame skipped_frame(const ClipPasses& passes, int frame,
                                         const std::exception_ptr& fault);

/// What is told of a clip of whose `count` frames not one could be converted; `first` is the first one's fault.
[[nodiscard]] std::string no_frame_left(const std::string& first, int count);

/// Whether any of the frames that a clip was made without can be converted now, for a task. Reads those alone, and not
/// all of them if one can.
[[nodiscard]] bool can_be_mended(const ClipPasses& passes, const ClipTask& task,
                                 const MaterialLibrary& materials, const std::vector<SkippedFrame>& skipped);

}  // namespace thermal
