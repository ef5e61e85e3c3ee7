#pragma once

#include <functional>
#include <optional>
#include <string>

#include "dataset/run/shards.h"

namespace veldt {

/// Value of an environment variable; empty if it is not set.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;

/// The process's own environment.
[[nodiscard]] std::optional<std::string> own_environment(const std::string& name);

/// --shard: "I/N" with 0 <= I < N, or "auto": the index of this job in a Slurm array, a Kubernetes Indexed Job or a
/// parallel GitLab job. ConfigError for an invalid text, or invalid variables of that job.
[[nodiscard]] thermal::Shard parse_shard(const std::string& text, const Environment& environment);

}  // namespace veldt
