#pragma once

#include <memory>

#include "dataset/clip/task.h"

/// Gives a task's clip settings of its own, which are to be changed.
inline thermal::ClipSettings& own_settings(thermal::ClipTask& task) {
  auto settings = std::make_shared<thermal::ClipSettings>(task.settings());
  task.clip.settings = settings;
  return *settings;
}
