#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "base/version.h"
#include "bench/convert_suite.h"
#include "bench/engines_suite.h"
#include "bench/heat_suite.h"
#include "bench/labels_suite.h"
#include "bench/maps_suite.h"
#include "bench/radiance_suite.h"
#include "bench/render_suite.h"
#include "bench/sensor_suite.h"
#include "bench/truth/suite.h"
#include "cli/command.h"
#include "cli/output.h"
#include "io/assets.h"
#include "io/config/materials.h"
#include "io/system/child_process.h"
#if VELDT_BALANCE
#include "bench/balance_suite.h"
#endif

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
      print("\n{:<38}{:>10}{:>10}{:>12}{:>12}{:>12}{:>12}\n", shown, "ns/pixel", "x memcpy", "worst rel.",
            "rms rel.", "worst mK", "rms mK");
      group = shown;
    }
    const std::string copies = row.times_memcpy > 0 ? fmt::format("{:.1f}", row.times_memcpy) : "";
    print("  {:<36}{:>10.2f}{:>10}{:>12.2g}{:>12.2g}{:>12.2g}{:>12.2g}{}\n", row.name, row.ns_per_pixel,
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
      print("\n{:<34}{:>10}{:>10}\n", row.group, "ms/frame", "x memcpy");
      group = row.group;
    }
    const std::string copies = row.times_memcpy > 0 ? fmt::format("{:.1f}", row.times_memcpy) : "";
    print("  {:<32}{:>10.3f}{:>10} ", row.name, row.ms_per_frame, copies);
    for (const thermal::Figure& figure : row.figures) print("  {} {:.2g}", figure.name, figure.value);
    print("\n");
  }
}

thermal::Json to_json(const thermal::RenderRow& row) {
  thermal::Json figures = thermal::Json::object();
  for (const thermal::Figure& figure : row.figures) figures[figure.name] = figure.value;
  return {{"group", row.group}, {"name", row.name}, {"figures", figures}};
}

thermal::Json to_json(const thermal::ConvertRow& row) {
  thermal::Json figures = thermal::Json::object();
  for (const thermal::Figure& figure : row.figures) figures[figure.name] = figure.value;
  thermal::Json json = {{"group", row.group}, {"name", row.name}, {"ms", row.ms}, {"mb_per_s", row.mb_per_s}};
  if (!row.limit.empty()) json["limit"] = row.limit;
  if (!row.limit.empty()) json["times_limit"] = row.times_limit;
  if (!row.bound.empty()) json["bound"] = row.bound;
  json["figures"] = figures;
  return json;
}

/// Whole numbers in full, others with three digits.
std::string short_number(double value) {
  return value == std::floor(value) ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

void print_table(const std::vector<thermal::RenderRow>& rows) {
  std::string group;
  for (const thermal::RenderRow& row : rows) {
    if (row.group != group) {
      print("\n{:<32}", row.group);
      for (const thermal::Figure& figure : row.figures) print("{:>15}", figure.name);
      print("\n");
      group = row.group;
    }
    print("  {:<30}", row.name);
    for (const thermal::Figure& figure : row.figures) print("{:>15}", short_number(figure.value));
    print("\n");
  }
}

void print_table(const std::vector<thermal::ConvertRow>& rows) {
  std::string group;
  for (const thermal::ConvertRow& row : rows) {
    if (row.group != group) {
      print("\n{:<44}{:>10}{:>10}{:>10}\n", row.group, "ms/frame", "MB/s", "x limit");
      group = row.group;
    }
    const std::string times =
        row.limit.empty() ? "" : fmt::format("{:>10.1f}  {:<12}", row.times_limit, row.limit);
    print("  {:<42}{:>10.3f}{:>10.0f}{:<24}", row.name, row.ms, row.mb_per_s, times);
    for (const thermal::Figure& figure : row.figures)
      print("  {} {}", figure.name, short_number(figure.value));
    print("\n");
    if (!row.bound.empty()) print("    bound by {}\n", row.bound);
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
  print_json(document);
  return kDone;
}

std::vector<std::string> suite_names() {
  std::vector<std::string> names = {"radiance", "heat", "sensor", "truth", "labels", "convert"};
#if VELDT_BALANCE
  names.emplace_back("balance");
#endif
  names.emplace_back("render");
  names.emplace_back("engines");
  names.emplace_back("maps");
  return names;
}

struct BenchArguments {
  std::string suite = "radiance";
  std::string blender;
  std::string only;
  bool json = false;
};

std::function<void(const std::string&)> teller(bool quiet) {
  return [quiet](const std::string& what) {
    if (!quiet) print_error("measuring {}\n", what);
  };
}

std::vector<thermal::RenderRow> measure_rendering(const BenchArguments& options, bool quiet) {
  return thermal::run_render_suite({find_blender(options.blender), thermal::Assets::find(), teller(quiet)});
}

/// Without a Blender on PATH, measures Embree alone.
std::vector<thermal::RenderRow> measure_engines(const BenchArguments& options, const CommonOptions& common) {
  thermal::Path blender;
  if (!options.blender.empty() || !thermal::find_program("blender").empty()) {
    blender = find_blender(options.blender);
  } else {
    print_error("no blender on PATH: Cycles is not measured; name one with --blender PATH\n");
  }
  return thermal::run_engines_suite({blender, thermal::Assets::find(), common.threads, teller(common.quiet)});
}

int run_bench(const BenchArguments& options, const CommonOptions& common) {
  const bool quiet = common.quiet;
  if (options.suite == "sensor") return show(options.suite, thermal::run_sensor_suite(), options.json);
  if (options.suite == "truth")
    return show(options.suite, thermal::run_truth_suite(teller(quiet), options.only), options.json);
  if (options.suite == "labels") return show(options.suite, thermal::run_labels_suite(), options.json);
#if VELDT_BALANCE
  if (options.suite == "balance")
    return show(options.suite, thermal::run_balance_suite(teller(quiet)), options.json);
#endif
  if (options.suite == "render") return show(options.suite, measure_rendering(options, quiet), options.json);
  if (options.suite == "maps") {
    const thermal::MapsSuiteTask task = {thermal::Assets::find(), common.threads, teller(quiet)};
    return show(options.suite, thermal::run_maps_suite(task), options.json);
  }
  if (options.suite == "engines") return show(options.suite, measure_engines(options, common), options.json);
  const thermal::MaterialLibrary materials = thermal::read_materials(thermal::Assets::find());
  if (options.suite == "heat")
    return show(options.suite, thermal::run_heat_suite(materials, teller(quiet)), options.json);
  if (options.suite == "convert")
    return show(options.suite, thermal::run_convert_suite(materials, teller(quiet)), options.json);
  return show(options.suite, thermal::run_radiance_suite(materials), options.json);
}

}  // namespace

void add_bench(Parser& parser) {
  Command command = parser.add_command("bench", "Speed and error of every kernel, measured on this machine");
  command.footer("Example: veldt bench --suite engines");
  auto options = std::make_shared<BenchArguments>();
  command.add_option("--suite", options->suite, "What to measure").one_of(suite_names()).shows_default();
  command
      .add_option("--blender", options->blender,
                  "Blender that --suite render and engines measure, instead of the one on PATH")
      .type_name("PATH");
  command.add_option("--only", options->only, "Group of rows that --suite truth measures, instead of all")
      .one_of(thermal::truth_groups())
      .type_name("GROUP");
  command.add_flag("--json", options->json, "Print JSON");
  command.runs([options](const CommonOptions& common) { return run_bench(*options, common); });
}

}  // namespace veldt
