#pragma once

#include <functional>
#include <optional>
#include <string>

#include "dataset/run/shards.h"

namespace veldt {

/// Value of a variable of the environment; none if it is not set.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;

/// The process's own.
[[nodiscard]] std::optional<std::string> own_environment(const std::string& name);

/// --shard: "I/N" with 0 <= I < N, or "auto": the place of this job among those of a Slurm array, a Kubernetes Indexed
/// Job or a parallel GitLab job. ConfigError says what is wrong with the text, or with the variables of that job.
[[nodiscard]] thermal::Shard parse_shard(const std::string& text, const Environment& environment);

}  // namespace veldt
