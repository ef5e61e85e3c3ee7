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

/// The meaning of exit codes, for help.
std::string list_exit_codes() {
  std::vector<std::string> all;
  for (const auto& [code, meaning] : kExitMeanings) all.push_back(fmt::format("{} {}", code, meaning));
  return thermal::list_names(all);
}

bool is_full(const std::error_code& error) {
  return error == std::errc::no_space_on_device || error == std::error_code(EDQUOT, std::generic_category());
}

/// Runs a command with its threads and turns exceptions into messages and exit codes.
int run_guarded(const Parser& parser) {
  const int threads = parser.common().threads;
  try {
    return thermal::with_threads(threads > 0 ? threads : thermal::find_cores().usable(),
                                 [&] { return parser.run(); });
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

void add_settings(Command& command, std::vector<std::string>& settings) {
  command.add_option("--set", settings, "Change the config, e.g. season=summer sensor.preset=boson_640_14mm")
      .type_name("KEY=VALUE");
}

void add_engine(Command& command, std::string& engine) {
  command
      .add_option(
          "--engine", engine,
          "What renders: embree, the ray caster; blender; or auto: embree wherever it can draw the config "
          "(default: render.engine of the config, or auto)")
      .one_of({"auto", "blender", "embree"})
      .type_name("NAME");
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

std::unique_ptr<Parser> make_parser() {
  auto parser = std::make_unique<Parser>(std::string(kPurpose) + ".\nExit codes: " + list_exit_codes() + ".");
  for (const auto& add : kCommands) add(*parser);
  return parser;
}

int run_command_line(int argc, const char* const* argv) {
  const std::unique_ptr<Parser> parser = make_parser();
  const std::optional<int> exit_code = parser->parse(argc, argv);
  return written(exit_code ? *exit_code : run_guarded(*parser));
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

void add_box_style(Command& command, thermal::BoxStyle& style, const std::string& help) {
  command
      .add_option(
          "--box-style",
          [&style](const std::string& name) {
            style = name == "drawn" ? thermal::BoxStyle::drawn : thermal::BoxStyle::visible;
          },
          help)
      .one_of({"visible", "drawn"})
      .shows_default("visible");
}

namespace {

constexpr double kPixels = 1e6;
constexpr double kMostMegapixels = 1e6;

}  // namespace

void add_max_megapixels(Command& command, double& max_megapixels) {
  command
      .add_option("--max-megapixels", max_megapixels,
                  "Refuse files that claim more pixels, before memory is allocated for them")
      .type_name("N")
      .shows_default();
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
