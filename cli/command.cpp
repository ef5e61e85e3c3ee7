#include "cli/command.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text.h"
#include "base/version.h"
#include "dataset/run/render.h"
#include "io/system/machine.h"

namespace veldt {
namespace {

/// The table of commands, in the order of the help; CMake options of these names leave some out.
constexpr std::array kCommands = {
    add_generate, add_plan,   add_render,  add_convert,  add_merge,
    add_cluster,  add_export, add_inspect, add_validate,
#if VELDT_BALANCE
    add_balance,
#endif
    add_evaluate,
#if VELDT_COMPARE
    add_compare,  add_fit,
#endif
#if VELDT_REPORT
    add_report,
#endif
#if VELDT_VIDEO
    add_video,    add_view,
#endif
    add_stream,   add_budget, add_heat,    add_radiance, add_camera,
#if VELDT_BENCH
    add_bench,
#endif
    add_doctor,
};

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// The fault of an unknown option, perhaps a misspelt one; empty if there is none.
std::string unknown_option(const CLI::App& command) {
  const std::vector<std::string> rest = command.remaining();
  const auto option =
      std::ranges::find_if(rest, [](const std::string& word) { return word.starts_with("--"); });
  if (option == rest.end()) return "";
  const std::string name = option->substr(0, option->find('='));
  std::vector<std::string> known;
  for (const CLI::Option* one : command.get_options({})) known.push_back(one->get_single_name());
  const std::string meant = thermal::near_miss(name.substr(2), known);
  if (meant.empty()) return "unknown option " + name;
  const bool is_option = command.get_option_no_throw("--" + meant) != nullptr;
  return "unknown option " + name + "; did you mean " + (is_option ? "--" + meant : meant + ", without --") +
         "?";
}

/// The fault of a command line, as one line.
std::string usage_fault(const CLI::App* app, const CLI::Error& error) {
  const std::vector<CLI::App*> named = app->get_subcommands();
  if (!named.empty()) {
    const CLI::App* command = named.front();
    const std::string misspelt = unknown_option(*command);
    return fmt::format("{}; see veldt {} --help", misspelt.empty() ? error.what() : misspelt,
                       command->get_name());
  }
  const std::vector<std::string> unknown = app->remaining();
  if (!unknown.empty() && unknown.front().starts_with('-'))
    return fmt::format("option {} before a command; see veldt --help", unknown.front());
  const std::vector<std::string> known = command_names(*app);
  const std::string choice = "expected one of " + thermal::list_names(known, known.size());
  if (unknown.empty()) return fmt::format("no command; {}; see veldt --help", choice);
  return fmt::format("unknown command \"{}\"; {}{}", unknown.front(), choice,
                     thermal::did_you_mean(unknown.front(), known));
}

/// The words after the program's name in reverse order, for the parser; `help X` is an alias of `X --help`.
std::vector<std::string> words_of(const CLI::App& app, int argc, const char* const* argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (!words.empty() && words.front() == "help") {
    words.erase(words.begin());
    const std::vector<std::string> known = command_names(app);
    if (words.empty() || std::ranges::find(known, words.front()) != known.end()) words.emplace_back("--help");
  }
  std::ranges::reverse(words);
  return words;
}

/// The meaning of exit codes, for help.
std::string list_exit_codes() {
  std::vector<std::string> all;
  for (const auto& [code, meaning] : kExitMeanings) all.push_back(fmt::format("{} {}", code, meaning));
  return thermal::list_names(all);
}

/// Prints help, the version or the fault of the command line.
int print_parsed(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream out;
  std::ostringstream fault;
  const int code = app.exit(error, out, fault);
  fmt::print(stdout, "{}", out.str());
  print_fault(fault.str());
  return code == 0 ? kDone : kBadUsage;
}

bool is_full(const std::error_code& error) {
  return error == std::errc::no_space_on_device || error == std::error_code(EDQUOT, std::generic_category());
}

/// Runs a command with its threads and turns exceptions into messages and exit codes.
int run_guarded(const Session& session) {
  const int threads = session.common.threads;
  try {
    return thermal::with_threads(threads > 0 ? threads : thermal::find_cores().usable(), session.run);
  } catch (const thermal::ConfigError& error) {
    print_fault(error.what());
    return kBadUsage;
  } catch (const thermal::TryAgainError& error) {
    print_fault(error.what());
    return kTryAgain;
  } catch (const thermal::Cancelled& error) {
    print_fault(std::string(error.what()) + "; run the same command again to resume");
    return 128 + stop_signal();
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string place = error.path1().string();
    print_fault(place.empty() ? error.what() : place + ": " + error.code().message());
    return is_full(error.code()) ? kTryAgain : kFailed;
  } catch (const std::bad_alloc&) {
    throw;  // run_program() reports it without allocating
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
  command->add_option("--threads", session.common.threads, "Number of threads; 0: one per usable core")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  return command;
}

void add_settings(CLI::App* command, std::vector<std::string>& settings) {
  command->add_option("--set", settings, "Change the config, e.g. season=summer sensor.preset=boson_640_14mm")
      ->type_name("KEY=VALUE");
}

void add_engine(CLI::App* command, std::string& engine) {
  command
      ->add_option(
          "--engine", engine,
          "What renders: embree, the ray caster; blender; or auto: embree wherever it can draw the config "
          "(default: render.engine of the config, or auto)")
      ->check(CLI::IsMember({"auto", "blender", "embree"}))
      ->type_name("NAME");
}

std::vector<std::string> with_engine(std::vector<std::string> settings, const std::string& engine) {
  if (!engine.empty()) settings.push_back("render.engine=" + engine);
  return settings;
}

thermal::ResolvedConfig load_config(const thermal::Path& file, const std::vector<std::string>& settings,
                                    const thermal::Assets& assets) {
  thermal::Json document = read_named_document(file);
  try {
    for (const std::string& setting : settings) thermal::apply_setting(document, setting);
    thermal::root_files(document, std::filesystem::absolute(file).parent_path());
    return thermal::resolve_config(std::move(document), file.string(), assets);
  } catch (const thermal::IoError& error) {
    throw thermal::ConfigError(error.what());
  }
}

thermal::Path find_blender(const std::string& named) { return thermal::find_blender(named, "--blender"); }

void add_commands(CLI::App& app, Session& session) {
  app.name("veldt");
  app.description(std::string(kPurpose) + ".\nExit codes: " + list_exit_codes() + ".");
  app.set_version_flag("-V,--version", std::string(thermal::kVersion));
  app.require_subcommand(1);
  for (const auto& add : kCommands) add(app, session);
}

int run_command_line(int argc, const char* const* argv) {
  CLI::App app;
  Session session;
  add_commands(app, session);
  app.failure_message(usage_fault);
  try {
    app.parse(words_of(app, argc, argv));
  } catch (const CLI::ParseError& error) {
    return written(print_parsed(app, error));
  }
  return written(run_guarded(session));
}

namespace {

bool can_be_read(const thermal::Path& file) {
  std::error_code none;
  return std::filesystem::is_regular_file(file, none) && ::access(file.c_str(), R_OK) == 0;
}

}  // namespace

thermal::Json read_named_document(const thermal::Path& file) {
  try {
    return thermal::read_json(file);
  } catch (const thermal::IoError& error) {
    if (can_be_read(file)) throw;
    throw thermal::ConfigError(error.what());
  }
}

namespace {

/// A signal handler can only reach a global; this is the program's only one.
std::atomic<int> received{0};  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

void remember(int signal) {
  received = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void watch_for_stop() {
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

int stop_signal() noexcept { return received; }

void add_box_style(CLI::App& command, thermal::BoxStyle& style, const std::string& help) {
  command
      .add_option_function<std::string>(
          "--box-style",
          [&style](const std::string& name) {
            style = name == "drawn" ? thermal::BoxStyle::drawn : thermal::BoxStyle::visible;
          },
          help)
      ->check(CLI::IsMember({"visible", "drawn"}))
      ->default_str("visible");
}

namespace {

constexpr double kPixels = 1e6;
constexpr double kMostMegapixels = 1e6;

}  // namespace

void add_max_megapixels(CLI::App* command, double& max_megapixels) {
  command
      ->add_option("--max-megapixels", max_megapixels,
                   "Refuse files that claim more pixels, before memory is allocated for them")
      ->type_name("N")
      ->capture_default_str();
}

thermal::ReadLimits read_limits(double max_megapixels) {
  const double pixels = max_megapixels * kPixels;
  if (!(pixels >= 1 && max_megapixels <= kMostMegapixels)) {  // this form rejects NaN
    throw thermal::ConfigError(thermal::fault("--max-megapixels", fmt::format("{}", max_megapixels), "",
                                              "at least 0.000001 (a pixel) and at most 1000000"));
  }
  return {.pixels = std::llround(pixels)};
}

}  // namespace veldt
