#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/output.h"
#include "cli/parser.h"
#include "io/assets.h"
#include "io/config/config.h"
#include "io/json/file.h"
#include "io/pass_reader.h"
#include "io/system/files.h"
#include "labels/box_style.h"

namespace veldt {

/// Meaning of exit codes, for help and manual.
inline constexpr std::array<std::pair<int, const char*>, 5> kExitMeanings = {
    {{kDone, "done"},
     {kFailed, "failed"},
     {kBadUsage, "bad usage or config"},
     {kSomeRejected, "some inputs rejected"},
     {kTryAgain, "try again later"}}};

/// The program's purpose, without a full stop.
inline constexpr const char* kPurpose = "Labelled thermal drone video of the savanna, for training detectors";

/// Each adds one command.
void add_generate(Parser& parser);
void add_render(Parser& parser);
void add_plan(Parser& parser);
void add_convert(Parser& parser);
void add_merge(Parser& parser);
void add_cluster(Parser& parser);
void add_export(Parser& parser);
void add_inspect(Parser& parser);
void add_validate(Parser& parser);
void add_evaluate(Parser& parser);
void add_compare(Parser& parser);
void add_fit(Parser& parser);
void add_report(Parser& parser);
void add_video(Parser& parser);
void add_view(Parser& parser);
void add_stream(Parser& parser);
void add_balance(Parser& parser);
void add_budget(Parser& parser);
void add_heat(Parser& parser);
void add_radiance(Parser& parser);
void add_camera(Parser& parser);
void add_bench(Parser& parser);
void add_doctor(Parser& parser);

/// The program's parser, with all of these commands.
[[nodiscard]] std::unique_ptr<Parser> make_parser();

/// Adds --set KEY=VALUE …, changes to a config.
void add_settings(Command& command, std::vector<std::string>& settings);

/// Adds --engine NAME, an alias of --set render.engine=NAME.
void add_engine(Command& command, std::string& engine);

/// The settings, with the engine if one is given.
[[nodiscard]] std::vector<std::string> with_engine(std::vector<std::string> settings,
                                                   const std::string& engine);

/// Reads a config, applies `settings` and checks it. Faults of the file are ConfigErrors; IoError for a failure of the
/// machine.
[[nodiscard]] thermal::ResolvedConfig load_config(const thermal::Path& file,
                                                  const std::vector<std::string>& settings,
                                                  const thermal::Assets& assets);

/// thermal::find_blender() for the option --blender.
[[nodiscard]] thermal::Path find_blender(const std::string& named);

/// Parses and runs a command line; errors go to standard error. Returns the exit code.
int run_command_line(int argc, const char* const* argv);

/// Reads a JSON document that the user names. ConfigError if it is missing or not readable for this user; IoError for a
/// failure of the machine.
[[nodiscard]] thermal::Json read_named_document(const thermal::Path& file);

/// From now on Ctrl-C and SIGTERM request a stop instead of ending the program; a second one ends it.
void watch_for_stop();

/// The signal that requested a stop; 0 if none did.
[[nodiscard]] int stop_signal() noexcept;

/// Adds --box-style, which sets `style`.
void add_box_style(Command& command, thermal::BoxStyle& style, const std::string& help);

/// Adds --max-megapixels N to a command that reads passes.
void add_max_megapixels(Command& command, double& max_megapixels);

/// The limits of --max-megapixels. ConfigError if it is not a number of pixels.
[[nodiscard]] thermal::ReadLimits read_limits(double max_megapixels);

}  // namespace veldt
