#pragma once

#include "dataset/exports/plan.h"

namespace thermal {

/// MOTChallenge's layout: SPLIT/CLIP/{img1/000001.png …, gt/gt.txt, seqinfo.ini}, seqmaps/NAME-SPLIT.txt, classes.txt.
/// Rows of gt.txt: frame, track, left, top, width, height, whether it counts (0: ignored, crowd), class (the category's
/// id, or its index from 1 if ids are texts; classes.txt has the names), visibility (1 where unknown); sorted by frame
/// and track. Frames and pixels count from 1: the top left pixel's corner is (1, 1). Frames are numbered without gaps,
/// as trackers expect, in the order of their indices. Tracks are numbered as in the labels, or from 1 in a clip that
/// has ids below 1. seqinfo.ini has no frame rate where it is unknown.
/// DataError if a label has no track, or pictures of a clip differ in kind or size, or have no order in time.
[[nodiscard]] ExportPlan plan_mot(const ExportInput& input);

}  // namespace thermal
