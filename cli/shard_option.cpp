#include "cli/shard_option.h"

#include <array>
#include <charconv>
#include <cstdlib>

#include <fmt/format.h>

#include "base/error.h"

namespace veldt {
namespace {

/// A scheduler's environment variables for the index of a job and the number of jobs.
struct Scheduler {
  const char* index = "";
  const char* count = "";
  const char* last = "";  ///< highest index of all jobs; empty: unknown
  int first = 0;          ///< index of the first job
  const char* rule = "";
};
constexpr std::array<Scheduler, 3> kSchedulers = {
    {{.index = "SLURM_ARRAY_TASK_ID",
      .count = "SLURM_ARRAY_TASK_COUNT",
      .last = "SLURM_ARRAY_TASK_MAX",
      .first = 0,
      .rule = "a whole array, from 0 to SLURM_ARRAY_TASK_COUNT - 1; for some of its tasks, give I/N"},
     {.index = "JOB_COMPLETION_INDEX",
      .count = "JOB_COMPLETIONS",
      .first = 0,
      .rule = "from 0 to JOB_COMPLETIONS - 1"},
     {.index = "CI_NODE_INDEX", .count = "CI_NODE_TOTAL", .first = 1, .rule = "from 1 to CI_NODE_TOTAL"}}};

std::optional<int> whole_number(std::string_view text) {
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

bool is_shard(const thermal::Shard& shard) { return shard.index >= 0 && shard.index < shard.count; }

int read_variable(const char* name, const Environment& environment) {
  const std::string text = environment(name).value_or("nothing");
  if (const auto number = whole_number(text)) return *number;
  throw thermal::ConfigError(thermal::fault(name, text, "", "a whole number, for --shard auto"));
}

/// Tasks 3 and 5 of an array of 8 are an array of two: its shards of N = 2 would differ.
bool is_whole_array(const Scheduler& scheduler, const thermal::Shard& shard, const Environment& environment) {
  const std::string last = std::to_string(scheduler.first + shard.count - 1);
  return environment(scheduler.last).value_or(last) == last;
}

thermal::Shard shard_of(const Scheduler& scheduler, const Environment& environment) {
  const int index = read_variable(scheduler.index, environment);
  const thermal::Shard shard = {.index = index - scheduler.first,
                                .count = read_variable(scheduler.count, environment)};
  if (is_shard(shard) && is_whole_array(scheduler, shard, environment)) return shard;
  throw thermal::ConfigError(thermal::fault(fmt::format("{} of {}", scheduler.index, shard.count),
                                            std::to_string(index), "", scheduler.rule));
}

thermal::Shard shard_of_job(const Environment& environment) {
  for (const Scheduler& scheduler : kSchedulers)
    if (environment(scheduler.index)) return shard_of(scheduler, environment);
  throw thermal::ConfigError(
      thermal::fault("--shard", "auto", "",
                     "SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX or CI_NODE_INDEX in the environment"));
}

}  // namespace

std::optional<std::string> own_environment(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  return value != nullptr ? std::optional<std::string>(value) : std::nullopt;
}

thermal::Shard parse_shard(const std::string& text, const Environment& environment) {
  if (text == "auto") return shard_of_job(environment);
  const std::string_view all = text;
  const std::size_t slash = all.find('/');
  if (slash != std::string_view::npos) {
    const std::optional<int> index = whole_number(all.substr(0, slash));
    const std::optional<int> count = whole_number(all.substr(slash + 1));
    if (const thermal::Shard shard{index.value_or(-1), count.value_or(0)}; is_shard(shard)) return shard;
  }
  throw thermal::ConfigError(thermal::fault("--shard", text, "", "I/N with I from 0 to N - 1, or auto"));
}

}  // namespace veldt
