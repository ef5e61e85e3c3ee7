#!/usr/bin/env bash
# The user's way first, with the packages of `./run demo` alone: build, two frames, `veldt doctor`, installation. Then
# the linters and all tests but the nightly ones, which install more. One build of the library serves all: its warnings
# are errors from the start. The tests of every day must keep to their budget.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export VELDT_WERROR=1 VELDT_HOLD_BUDGET=1

took=()
for command in tests/fresh/two_frames.sh "./run lint" "./run test --all"; do
  start=$SECONDS
  echo "===== $command ====="
  $command
  took+=("$command $((SECONDS - start)) s")
done
printf '===== %s =====\n' "${took[@]}"
