#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/files.h"
#include "io/name_pattern.h"

namespace thermal {

/// The name of a frame's file, and the position of the frame's number in it, if a pattern gives it.
struct FrameName {
  std::string name;
  NumberPlace number = {};  ///< no digits: unknown
};

/// Files of a clip in order. Frames are ordered by the number in their names and spaced by the greatest common step;
/// steps without a file are gaps.
struct FrameSequence {
  struct Frame {
    FrameName name;  ///< of a gap: the name it would have
    bool is_gap = false;
  };
  std::vector<Frame> frames;
  std::int64_t step = 1;  ///< between numbers; 1 without numbers

  [[nodiscard]] int gaps() const noexcept;
};

/// Sorts files. If the position of a name's number is unknown, it is the last run of digits, before the extension,
/// that is not the same in all names. Names without digits are sorted as texts, without gaps. Repeated names count
/// once. DataError, starting with `where`, if some names have digits and others do not, two have one number, a number
/// has over 18 digits, or there would be more than ten gaps per file.
[[nodiscard]] FrameSequence sequence_of(std::vector<FrameName> names, const std::string& where);

/// A pattern that matches all these names, with # for the number; empty if there is none.
[[nodiscard]] std::string pattern_of(const FrameSequence& sequence);

/// Files of a folder, by name, without hidden ones. IoError with the folder if it cannot be read.
[[nodiscard]] std::vector<std::string> files_in(const Path& folder);

/// Those that match a pattern.
[[nodiscard]] std::vector<FrameName> names_matching(const NamePattern& pattern,
                                                    const std::vector<std::string>& names);

/// Those that are passes: .exr files, or .png files if there are none; extensions in any case.
[[nodiscard]] std::vector<FrameName> passes_among(const std::vector<std::string>& names);

}  // namespace thermal
