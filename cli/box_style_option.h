#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "labels/box_style.h"

namespace veldt {

/// Adds --box-style, which sets `style`.
void add_box_style(CLI::App& command, thermal::BoxStyle& style, const std::string& help);

}  // namespace veldt
