#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/files.h"
#include "io/name_pattern.h"

namespace thermal {

/// The name of a frame's file, and where in it the frame's number is, as far as a pattern tells.
struct FrameName {
  std::string name;
  NumberPlace number = {};  ///< no digits: not known
};

/// Files of a clip in order. The number in a frame's name says when it comes; frames are as far apart as their greatest
/// common step, and those between that have no file are gaps.
struct FrameSequence {
  struct Frame {
    FrameName name;  ///< of a gap: the one it would have
    bool is_gap = false;
  };
  std::vector<Frame> frames;
  std::int64_t step = 1;  ///< between numbers; 1 where there are none

  [[nodiscard]] int gaps() const noexcept;
};

/// Puts files in order. Where a name's number is not known it is the last run of digits, before the ending, that is not
/// the same in all names. Names of which none has digits are sorted as texts, without gaps. A name that comes twice
/// counts once. DataError, `where` before it, where some names have digits and others none, two have one number, a number
/// has over 18 digits, or there would be more than ten gaps a file.
[[nodiscard]] FrameSequence sequence_of(std::vector<FrameName> names, const std::string& where);

/// A pattern that all these names match, # for the number; empty if there is none.
[[nodiscard]] std::string pattern_of(const FrameSequence& sequence);

/// Files of a folder, by name; hidden ones are left out. IoError naming the folder if it cannot be read.
[[nodiscard]] std::vector<std::string> files_in(const Path& folder);

/// Those that match a pattern.
[[nodiscard]] std::vector<FrameName> names_matching(const NamePattern& pattern,
                                                    const std::vector<std::string>& names);

/// Those that are passes: .exr files, or .png files if there are none; the ending in any case.
[[nodiscard]] std::vector<FrameName> passes_among(const std::vector<std::string>& names);

}  // namespace thermal
