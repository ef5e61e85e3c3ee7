#!/usr/bin/env bash
# The user's way first, with the packages of `./run demo` alone: build, two frames, `veldt doctor`, installation. Then
# the linters, the documentation and all tests, which install more. One build of the library serves all: its warnings
# are errors from the start.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export VELDT_WERROR=1

took=()
for command in tests/fresh/two_frames.sh "./run lint" "./run docs" "./run test"; do
  start=$SECONDS
  echo "===== $command ====="
  $command
  took+=("$command $((SECONDS - start)) s")
done
printf '===== %s =====\n' "${took[@]}"
