#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/output.h"
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

/// Options of every command.
struct CommonOptions {
  bool quiet = false;
  std::string progress = "auto";
  int threads = 0;
};

/// A parsed command line: the command to run, and common options.
struct Session {
  CommonOptions common;
  std::function<int()> run;
};

/// Each adds one command to the parser; parsing sets session.run.
void add_generate(CLI::App& app, Session& session);
void add_render(CLI::App& app, Session& session);
void add_plan(CLI::App& app, Session& session);
void add_convert(CLI::App& app, Session& session);
void add_merge(CLI::App& app, Session& session);
void add_cluster(CLI::App& app, Session& session);
void add_export(CLI::App& app, Session& session);
void add_inspect(CLI::App& app, Session& session);
void add_validate(CLI::App& app, Session& session);
void add_evaluate(CLI::App& app, Session& session);
void add_compare(CLI::App& app, Session& session);
void add_fit(CLI::App& app, Session& session);
void add_report(CLI::App& app, Session& session);
void add_video(CLI::App& app, Session& session);
void add_view(CLI::App& app, Session& session);
void add_stream(CLI::App& app, Session& session);
void add_balance(CLI::App& app, Session& session);
void add_budget(CLI::App& app, Session& session);
void add_heat(CLI::App& app, Session& session);
void add_radiance(CLI::App& app, Session& session);
void add_camera(CLI::App& app, Session& session);
void add_bench(CLI::App& app, Session& session);
void add_doctor(CLI::App& app, Session& session);

/// Adds the program's description and all of these commands to a new parser.
void add_commands(CLI::App& app, Session& session);

/// A subcommand with the common options.
CLI::App* add_command(CLI::App& app, Session& session, const std::string& name,
                      const std::string& description);

/// Adds --set KEY=VALUE …, changes to a config.
void add_settings(CLI::App* command, std::vector<std::string>& settings);

/// Adds --engine NAME, an alias of --set render.engine=NAME.
void add_engine(CLI::App* command, std::string& engine);

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
void add_box_style(CLI::App& command, thermal::BoxStyle& style, const std::string& help);

/// Adds --max-megapixels N to a command that reads passes.
void add_max_megapixels(CLI::App* command, double& max_megapixels);

/// The limits of --max-megapixels. ConfigError if it is not a number of pixels.
[[nodiscard]] thermal::ReadLimits read_limits(double max_megapixels);

}  // namespace veldt
