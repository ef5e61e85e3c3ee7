#!/bin/bash
# Makes the dataset {{name}} in {{shards}} shards on a Slurm cluster; written by `veldt cluster slurm`.
#
#   bash FILE                  submits all shards, and a job that merges them afterwards
#   bash FILE --array=3,5      only these shards, then the merge, which lists the shards to run again
#
# Every node needs veldt on PATH and sees the folders `plan` and `data`. Clips are made on the node's own disk.
#SBATCH --job-name=veldt_{{name}}
#SBATCH --array=0-{{last_shard}}%{{nodes}}
#SBATCH --cpus-per-task={{cores}}
#SBATCH --mem={{memory_gb}}G
#SBATCH --time={{minutes}}
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:TERM@120
set -uo pipefail

plan={{plan}}
data={{data}}
shards={{shards}}
most_restarts=5

# For a shell of any kind: the merge runs in /bin/sh, which may not know what printf %q writes.
quoted() { # TEXT
  printf "'%s'" "${1//\'/\'\\\'\'}"
}

submit() { # SBATCH_OPTIONS…
  local array
  array=$(sbatch --parsable "$@" "$0") || exit
  sbatch --dependency="afterany:${array%%;*}" --job-name=veldt_{{name}}_merge --time={{merge_minutes}} --mem={{memory_gb}}G \
    --wrap "veldt merge --plan $(quoted "$plan") --shards $shards $(quoted "$data")/shards/* --out $(quoted "$data/dataset") --progress plain"
}

# The code is 143 if Slurm asked to stop: two minutes before the time limit, or to free the node.
make_shard() {
  local scratch running code
  scratch=$(mktemp -d "${SLURM_TMPDIR:-${TMPDIR:-/tmp}}/veldt_XXXXXX") || return
  veldt generate --plan "$plan" --shard "$SLURM_ARRAY_TASK_ID/$shards" --out "$data/shards/$SLURM_ARRAY_TASK_ID" \
    --scratch "$scratch" --threads "$SLURM_CPUS_PER_TASK" --progress plain &
  running=$!
  trap 'kill -TERM "$running"' TERM
  wait "$running"
  code=$?
  if kill -0 "$running" 2>/dev/null; then # the signal ended `wait`, not the program
    wait "$running"
    code=$?
  fi
  rm -rf "$scratch"
  return "$code"
}

# No longer, once Slurm has begun to cancel the job or to requeue it: a cancelled job must not start again.
is_running() {
  [[ $(squeue --noheader --jobs "$SLURM_JOB_ID" --format %T) == RUNNING ]]
}

if [[ -z ${SLURM_ARRAY_TASK_ID:-} ]]; then
  submit "$@"
  exit
fi

# 75 and 143: try again, complete clips are kept. 1, 2 and 3: trying again does not help.
make_shard
code=$?
if ((code == 75 || code == 143)) && ((${SLURM_RESTART_COUNT:-0} < most_restarts)) && is_running; then
  scontrol requeue "$SLURM_JOB_ID" && exit 0
fi
exit "$code"
