#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <memory>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "cli/command.h"
#include "cli/output.h"
#include "dataset/plan/plan_store.h"
#include "dataset/run/options.h"
#include "io/assets.h"

namespace veldt {
namespace {

struct ClusterArguments {
  std::string scheduler;
  std::string plan;
  std::string data;
  std::string out;
  std::string image = "veldt:latest";
  std::string claim = "veldt-data";
  int nodes = 4;
  int shards = 0;
  int cores = 2;
  int memory_gb = 4;
};

using Values = std::map<std::string, std::string>;

/// Replaces each {{name}} of a template.
std::string filled_in(std::string text, const Values& values) {
  for (std::size_t begin = text.find("{{"); begin != std::string::npos; begin = text.find("{{", begin)) {
    const std::size_t end = text.find("}}", begin);
    const std::string& value = values.at(text.substr(begin + 2, end - begin - 2));
    text.replace(begin, end + 2 - begin, value);
    begin += value.size();
  }
  return text;
}

/// Single-quoted for a shell.
std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// The same text; ConfigError for tabs, line ends and invalid UTF-8, which schedulers, shells and YAML interpret
/// differently.
const std::string& checked(const char* what, const std::string& text) {
  if (thermal::printable(text) == text) return text;
  throw thermal::ConfigError(
      thermal::fault(what, text, "", "a text without control characters, in UTF-8, such as /data/park"));
}

/// A name valid in Kubernetes: lower-case letters, digits and hyphens, a letter or digit at both ends.
std::string label_of(const std::string& name) {
  std::string label;
  for (const char c : name) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    label += is_plain ? static_cast<char>(std::tolower(static_cast<unsigned char>(c))) : '-';
  }
  constexpr std::size_t kLongest = 40;  // of 63: jobs append to it for their pods
  label = label.substr(0, kLongest);
  const std::size_t first = label.find_first_not_of('-');
  return first == std::string::npos ? "dataset"
                                    : label.substr(first, label.find_last_not_of('-') - first + 1);
}

/// Four shards a node: then the last to end leaves the others idle for at most a quarter of their time.
int shard_count(const ClusterArguments& options, std::size_t clips) {
  constexpr int kShardsANode = 4;
  if (options.shards > 0) return options.shards;
  return std::clamp(kShardsANode * options.nodes, 1, std::max(1, static_cast<int>(clips)));
}

/// Time limit of a shard: three times the estimate, which is accurate within a factor of two, with a minimum. A shard
/// that reaches it continues with the clip after its last complete one.
int shard_minutes(const thermal::DatasetSpec& spec, int shards, int cores) {
  constexpr double kEstimatedCores = 2;
  constexpr double kMargin = 3;
  constexpr int kLeast = 15;
  const std::vector<int> dealt = thermal::deal_shards(spec, shards);
  std::vector<double> seconds(static_cast<std::size_t>(shards));
  for (std::size_t i = 0; i < dealt.size(); ++i)
    seconds[static_cast<std::size_t>(dealt[i])] += thermal::clip_seconds(spec, spec.clips[i].frames);
  const double longest_min = std::ranges::max(seconds) * kEstimatedCores / cores / 60;
  return kLeast + static_cast<int>(std::ceil(kMargin * longest_min));
}

/// Merging reads and checks every file once.
int merge_minutes(const thermal::Estimate& estimate) {
  constexpr double kBytesPerMinute = 3e9;  // 50 MB/s, as for a slow shared disk
  constexpr int kLeast = 15;
  return kLeast + static_cast<int>(std::ceil(estimate.bytes / kBytesPerMinute));
}

Values values_of(const ClusterArguments& options, const thermal::DatasetSpec& spec) {
  const int shards = shard_count(options, spec.clips.size());
  const int clips = static_cast<int>(spec.clips.size());
  const int frames = thermal::frames_of(spec.clips);
  const thermal::Path data =
      options.data.empty() ? thermal::Path(options.plan) / ".." : thermal::Path(options.data);
  const auto absolute = [](const char* what, const thermal::Path& folder) {
    return shell_quoted(
        checked(what, std::filesystem::weakly_canonical(std::filesystem::absolute(folder)).string()));
  };
  return {{"name", label_of(spec.name)},
          {"label", label_of(spec.name)},
          {"shards", std::to_string(shards)},
          {"last_shard", std::to_string(shards - 1)},
          {"nodes", std::to_string(options.nodes)},
          {"cores", std::to_string(options.cores)},
          {"memory_gb", std::to_string(options.memory_gb)},
          {"minutes", std::to_string(shard_minutes(spec, shards, options.cores))},
          {"merge_minutes", std::to_string(merge_minutes(thermal::estimate_run(spec, clips, frames)))},
          {"plan", absolute("plan", options.plan)},
          {"data", absolute("--data", data)},
          {"image", thermal::Json(checked("--image", options.image)).dump()},
          {"claim", thermal::Json(checked("--claim", options.claim)).dump()}};
}

int run_cluster(const ClusterArguments& options) {
  const thermal::Assets assets = thermal::Assets::find();
  const thermal::PlannedDataset dataset = thermal::PlanStore(options.plan, assets).open();
  const bool is_slurm = options.scheduler == "slurm";
  const thermal::Path file = assets.home() / "configs/cluster" / (is_slurm ? "slurm.sh" : "kubernetes.yaml");
  const std::string text = filled_in(thermal::read_file(file), values_of(options, dataset.config.spec));
  if (!options.out.empty()) {
    thermal::write_file_atomically(options.out, text);
    return kDone;
  }
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) print("{}\n", line);
  return kDone;
}

}  // namespace

void add_cluster(Parser& parser) {
  Command command =
      parser.add_command("cluster", "Write the jobs that make a planned dataset on Slurm or Kubernetes");
  command.footer("Example: veldt cluster slurm plan --nodes 8 --cores 4 --out job.sh");
  auto options = std::make_shared<ClusterArguments>();
  command.add_option("scheduler", options->scheduler, "What runs the jobs")
      .required()
      .one_of({"slurm", "kubernetes"});
  command.add_option("plan", options->plan, "A plan that veldt plan wrote").required().type_name("PLAN");
  command.add_option("--nodes", options->nodes, "Shards to run at the same time")
      .between(1, 100'000)
      .shows_default();
  command.add_option("--shards", options->shards, "Number of shards (default: four a node)")
      .between(1, 1'000'000)
      .type_name("N");
  command.add_option("--cores", options->cores, "Cores of a shard").between(1, 1024).shows_default();
  command.add_option("--memory-gb", options->memory_gb, "Memory of a shard").between(1, 4096).shows_default();
  command
      .add_option("--data", options->data,
                  "Slurm: folder that all nodes share, for shards and dataset (default: that of the plan)")
      .type_name("DIR");
  command.add_option("--image", options->image, "Kubernetes: image with veldt as its entry point")
      .type_name("NAME")
      .shows_default();
  command.add_option("--claim", options->claim, "Kubernetes: claim of the volume with the plan")
      .type_name("NAME")
      .shows_default();
  command.add_option("--out", options->out, "File to write, instead of standard output").type_name("FILE");
  command.runs([options](const CommonOptions& /*common*/) { return run_cluster(*options); });
}

}  // namespace veldt
