#!/usr/bin/env bash
# Prints a list of packages in `run`, one a line; or those of them that the other packages of the list bring along, as
# apt of this machine would install them.
#
# usage: tests/fresh/packages.sh LIST [--brought-along]      LIST: build, demo, test, lint, fuzz or fresh
#   ./run fresh tests/fresh/packages.sh demo --brought-along      on a minimal Debian
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# The assignments in `run`, as they are there.
eval "$(sed -n '/^[a-z]*_packages=(/,/)$/p' run)"
declare -n listed=$1_packages

others_bring() { # PACKAGE
  local package others=()
  for package in "${listed[@]}"; do
    [[ $package == "$1" ]] || others+=("$package")
  done
  apt-get --simulate --no-install-recommends install "${others[@]}" | grep -q "^Inst $1 "
}

if [[ ${2:-} != --brought-along ]]; then
  printf '%s\n' "${listed[@]}"
  exit
fi
apt-get -qq update
for package in "${listed[@]}"; do
  if others_bring "$package"; then echo "brought along: $package"; fi
done
