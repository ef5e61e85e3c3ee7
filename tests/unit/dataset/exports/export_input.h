#pragma once

#include "dataset/exports/plan.h"

/// A picture of 20 x 10 px of a video.
inline thermal::LabelImage picture(std::int64_t id, const std::string& file, std::size_t video,
                                   int frame_index) {
  return {
      .id = id, .file = file, .width_px = 20, .height_px = 10, .video = video, .frame_index = frame_index};
}

inline thermal::Label label(std::int64_t id, std::size_t image, std::size_t category, std::int64_t track,
                            thermal::LabelBox box) {
  thermal::Label made;
  made.id = id;
  made.image = image;
  made.category = category;
  made.track_id = track;
  made.box = box;
  return made;
}

/// Two videos, "east" with three pictures of which the last has no labels, and "west" with one.
inline thermal::ExportInput two_videos() {
  thermal::ExportInput input;
  input.set.name = "night";
  input.set.categories = {
      {.id = 1, .name = "human"}, {.id = 8, .name = "giraffe"}, {.id = 10, .name = "vehicle"}};
  input.set.videos = {{.name = "east", .frame_rate_hz = 12.5}, {.name = "west"}};
  input.set.images = {
      picture(11, "clips/east/ir8/000000.png", 0, 0), picture(12, "clips/east/ir8/000002.png", 0, 2),
      picture(13, "clips/east/ir8/000003.png", 0, 3), picture(14, "clips/west/ir8/000000.png", 1, 0)};
  input.set.labels = {label(1, 0, 0, 7, {.x_px = 0, .y_px = 0, .width_px = 5, .height_px = 2}),
                      label(2, 0, 1, 3, {.x_px = 4, .y_px = 5, .width_px = 8, .height_px = 5}),
                      label(3, 1, 0, 7, {.x_px = 2.5, .y_px = 1, .width_px = 1.25, .height_px = 3}),
                      label(4, 3, 2, 1, {.x_px = 10, .y_px = 2, .width_px = 4, .height_px = 4})};
  input.splits = {"train"};
  input.of_video = {0, 0};
  return input;
}

/// The same, east to train and west to val.
inline thermal::ExportInput two_splits() {
  thermal::ExportInput input = two_videos();
  input.splits = {"train", "val"};
  input.of_video = {0, 1};
  input.split_asked = true;
  return input;
}

/// Content of a planned file; "(none)" if no such file.
inline std::string text_of(const thermal::ExportPlan& plan, const std::string& to) {
  for (const thermal::PlannedText& text : plan.texts)
    if (text.to == to) return text.content;
  return "(none)";
}

/// Target of each picture, in the order of images.
inline std::vector<std::string> targets_of(const thermal::ExportPlan& plan) {
  std::vector<std::string> targets;
  for (const thermal::PlannedPicture& picture : plan.pictures) targets.push_back(picture.to);
  return targets;
}
