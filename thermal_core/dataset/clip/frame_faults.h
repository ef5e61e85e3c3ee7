#pragma once

#include <exception>
#include <string>
#include <vector>

#include "dataset/clip/record.h"
#include "dataset/clip/task.h"
#include "io/pass_reader.h"
#include "scene/material.h"

namespace thermal {

/// Reads a clip's frames within its limits. DataError if its camera's picture, at the resolution of the passes,
/// exceeds them; checked before memory of that size is allocated.
[[nodiscard]] PassReader reader_for(const ClipPasses& passes);

/// The file with a frame's planes. IoError if it is not a file, or if the manifest lists none for that frame.
[[nodiscard]] Path file_of(const ClipPasses& passes, int frame);

/// The message of an exception.
[[nodiscard]] std::string message_of(const std::exception_ptr& fault);

/// The message of an exception, without the file's name at its start.
[[nodiscard]] std::string without_name(const std::string& what, const Path& file);

/// The message for a frame that is skipped for a fault.
[[nodiscard]] SkippedFrame skipped_frame(const ClipPasses& passes, int frame,
                                         const std::exception_ptr& fault);

/// The message for a clip if none of its `count` frames could be converted; `first` is the first frame's message.
[[nodiscard]] std::string no_frame_left(const std::string& first, int count);

/// Whether any of a clip's skipped frames can be converted now, for a task. Reads only those, up to the first
/// success.
[[nodiscard]] bool can_be_mended(const ClipPasses& passes, const ClipTask& task,
                                 const MaterialLibrary& materials, const std::vector<SkippedFrame>& skipped);

}  // namespace thermal
