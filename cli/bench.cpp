#include <memory>

#include <fmt/format.h>

#include "base/version.h"
#include "bench/radiance_suite.h"
#include "bench/sensor_suite.h"
#include "cli/command.h"
#include "io/material_files.h"
#include "io/resources.h"

namespace veldt {
namespace {

thermal::Json to_json(const thermal::BenchRow& row) {
  return {{"group", row.group},
          {"name", row.name},
          {"ns_per_pixel", row.ns_per_pixel},
          {"worst_relative", row.worst_relative},
          {"rms_relative", row.rms_relative},
          {"worst_mk", row.worst_mk},
          {"rms_mk", row.rms_mk},
          {"times_memcpy", row.times_memcpy},
          {"dominated", row.dominated}};
}

void print_table(const std::vector<thermal::BenchRow>& rows) {
  std::string group;
  for (const thermal::BenchRow& row : rows) {
    const std::string shown = row.group.starts_with("term") ? "terms, 640 x 512" : row.group;
    if (shown != group) {
      fmt::print("\n{:<38}{:>10}{:>10}{:>12}{:>12}{:>12}{:>12}\n", shown, "ns/pixel", "x memcpy",
                 "worst rel.", "rms rel.", "worst mK", "rms mK");
      group = shown;
    }
    const std::string copies = row.times_memcpy > 0 ? fmt::format("{:.1f}", row.times_memcpy) : "";
    fmt::print("  {:<36}{:>10.2f}{:>10}{:>12.2g}{:>12.2g}{:>12.2g}{:>12.2g}{}\n", row.name, row.ns_per_pixel,
               copies, row.worst_relative, row.rms_relative, row.worst_mk, row.rms_mk,
               row.dominated ? "  dominated" : "");
  }
}

thermal::Json to_json(const thermal::StageRow& row) {
  thermal::Json figures = thermal::Json::object();
  for (const thermal::Figure& figure : row.figures) figures[figure.name] = figure.value;
  return {{"group", row.group},
          {"name", row.name},
          {"ms_per_frame", row.ms_per_frame},
          {"times_memcpy", row.times_memcpy},
          {"figures", figures}};
}

void print_table(const std::vector<thermal::StageRow>& rows) {
  std::string group;
  for (const thermal::StageRow& row : rows) {
    if (row.group != group) {
      fmt::print("\n{:<34}{:>10}{:>10}\n", row.group, "ms/frame", "x memcpy");
      group = row.group;
    }
    const std::string copies = row.times_memcpy > 0 ? fmt::format("{:.1f}", row.times_memcpy) : "";
    fmt::print("  {:<32}{:>10.3f}{:>10} ", row.name, row.ms_per_frame, copies);
    for (const thermal::Figure& figure : row.figures) fmt::print("  {} {:.2g}", figure.name, figure.value);
    fmt::print("\n");
  }
}

template <typename Row>
int show(const std::string& suite, const std::vector<Row>& rows, bool json) {
  if (!json) {
    print_table(rows);
    return kDone;
  }
  thermal::Json list = thermal::Json::array();
  for (const Row& row : rows) list.push_back(to_json(row));
  const thermal::Json document = {{"veldt_version", thermal::kVersion}, {"suite", suite}, {"rows", list}};
  fmt::print("{}\n", document.dump(2));
  return kDone;
}

int run(const std::string& suite, bool json) {
  if (suite == "sensor") return show(suite, thermal::run_sensor_suite(), json);
  return show(suite, thermal::run_radiance_suite(thermal::read_materials(thermal::find_home())), json);
}

}  // namespace

void add_bench(CLI::App& app, Session& session) {
  CLI::App* command =
      add_command(app, session, "bench", "Speed and error of every kernel, measured on this machine");
  struct Options {
    std::string suite = "radiance";
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  command->add_option("--suite", options->suite, "What to measure")
      ->check(CLI::IsMember({"radiance", "sensor"}))
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print JSON");
  command->callback(
      [options, &session] { session.run = [options] { return run(options->suite, options->json); }; });
}

}  // namespace veldt
