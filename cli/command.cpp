#include "cli/command.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/printable.h"
#include "base/text.h"
#include "base/version.h"
#include "cli/stop_signal.h"
#include "io/resources.h"

namespace veldt {
namespace {

/// The one table of commands, in the order help shows them.
constexpr std::array kCommands = {add_generate, add_render,   add_convert,  add_merge,    add_export,
                                  add_inspect,  add_validate, add_balance,  add_evaluate, add_report,
                                  add_video,    add_budget,   add_radiance, add_bench,    add_doctor};

void print_fault(const std::string& what) {
  std::istringstream lines(what);
  for (std::string line; std::getline(lines, line);)
    fmt::print(stderr, "veldt: {}\n", thermal::printable(line));
}

/// What is wrong with a command line, as one line.
std::string usage_fault(const CLI::App* app, const CLI::Error& error) {
  const std::vector<CLI::App*> named = app->get_subcommands();
  if (!named.empty())
    return fmt::format("veldt: {}; see veldt {} --help\n", error.what(), named.front()->get_name());
  const std::vector<std::string> unknown = app->remaining();
  if (!unknown.empty() && unknown.front().starts_with('-'))
    return fmt::format("veldt: option {} before a command; see veldt --help\n", unknown.front());
  std::vector<std::string> known;
  for (const CLI::App* command : app->get_subcommands({})) known.push_back(command->get_name());
  const std::string choice = "expected one of " + thermal::list_names(known);
  if (unknown.empty()) return fmt::format("veldt: no command; {}; see veldt --help\n", choice);
  return fmt::format("veldt: unknown command \"{}\"; {}{}\n", unknown.front(), choice,
                     thermal::did_you_mean(unknown.front(), known));
}

/// Runs a command and turns exceptions into messages and exit codes.
int run_guarded(const std::function<int()>& run) {
  try {
    return run();
  } catch (const thermal::ConfigError& error) {
    print_fault(error.what());
    return kBadUsage;
  } catch (const thermal::TryAgainError& error) {
    print_fault(error.what());
    return kTryAgain;
  } catch (const thermal::Cancelled& error) {
    print_fault(std::string(error.what()) + "; run the same command again to resume");
    return 128 + stop_signal();
  } catch (const std::exception& error) {
    print_fault(error.what());
    return kFailed;
  }
}

}  // namespace

CLI::App* add_command(CLI::App& app, Session& session, const std::string& name,
                      const std::string& description) {
  CLI::App* command = app.add_subcommand(name, description);
  command->add_flag("--quiet", session.common.quiet, "Print errors only");
  command->add_option("--progress", session.common.progress, "How to show progress, on standard error")
      ->check(CLI::IsMember({"auto", "plain", "json", "none"}))
      ->capture_default_str();
  command->add_option("--threads", session.common.threads, "Number of threads; 0: one per core")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  return command;
}

void add_settings(CLI::App* command, std::vector<std::string>& settings) {
  command->add_option("--set", settings, "Change the config, e.g. season=summer sensor.preset=boson_640_14mm")
      ->type_name("KEY=VALUE");
}

thermal::Config load_config(const thermal::Path& file, const std::vector<std::string>& settings,
                            const thermal::Path& home) {
  try {
    thermal::Json document = thermal::read_json(file);
    for (const std::string& setting : settings) thermal::apply_setting(document, setting);
    thermal::root_files(document, std::filesystem::absolute(file).parent_path());
    return thermal::resolve_config(std::move(document), file.string(), home);
  } catch (const thermal::IoError& error) {
    throw thermal::ConfigError(error.what());
  }
}

thermal::Path find_blender(const std::string& named) {
  thermal::Path found = thermal::find_program(named.empty() ? "blender" : named);
  if (!found.empty()) return found;
  if (!named.empty())
    throw thermal::ConfigError(thermal::fault("--blender", named, "", "an executable program"));
  throw thermal::IoError(
      "no blender on PATH; install it (apt-get install blender) or name one with --blender PATH");
}

int run_command_line(int argc, const char* const* argv) {
  CLI::App app(
      "Labelled thermal drone video of the savanna, for training detectors.\n"
      "Exit codes: 0 done, 1 failed, 2 bad usage or config, 3 some inputs rejected, 75 try again later.",
      "veldt");
  app.set_version_flag("--version", std::string(thermal::kVersion));
  app.require_subcommand(1);
  app.failure_message(usage_fault);
  Session session;
  for (const auto& add : kCommands) add(app, session);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kBadUsage;
  }
  return run_guarded(session.run);
}

}  // namespace veldt
