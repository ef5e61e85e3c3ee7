#!/usr/bin/env bash
# Drops one package at a time from the lists in `run` and reports what then fails on a fresh machine: the proof that
# ./run fresh can fail, and that each package is needed. Run by hand as root; a list takes an hour or so.
#
# usage: tests/fresh/drop_packages.sh SUITE LIST COMMAND [PACKAGE…]
#   tests/fresh/drop_packages.sh bookworm demo tests/fresh/two_frames.sh
#   tests/fresh/drop_packages.sh bookworm test './run test browser' chromium chromium-driver python3-selenium
#
# LIST is one of tests/fresh/packages.sh; without PACKAGE, all of it. Prints a row of a table a package: what the command
# ended with, or that the other packages bring it along, in which case nothing can fail and nothing is run.
# shellcheck disable=SC2016 # backquotes are Markdown's
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

readonly suite=$1 list=$2 command=$3
packages=("${@:4}")
readonly kept=$PWD/build/fresh/$suite
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$scratch/ccache" "$kept"

# A clone whose `run` lacks the package, with the base system and the downloads of this one.
clone_without() { # PACKAGE
  local clone=$scratch/veldt
  rm -rf "$clone"
  git clone --quiet "file://$PWD" "$clone"
  mkdir -p "$clone/build/fresh"
  ln -s "$kept" "$clone/build/fresh/$suite"
  sed -i -E "/^[a-z]*_packages=\(/,/\)$/ s/(^|[ (])${1//+/\\+}([ )]|$)/\1\2/" "$clone/run"
  git -C "$clone" -c user.name=fresh -c user.email=fresh@localhost commit --quiet --all --message "Drop $1"
}

# The first line of a log that says what is missing.
first_fault() { # LOG
  grep -aiE '\berror\b|not found|could not|fatal|no such file|no module|failed' "$1" |
    grep -avE 'debconf|Building|apt-utils|took [0-9]+ s' | head -n 1 | cut -c1-160
}

((${#packages[@]})) || mapfile -t packages < <(tests/fresh/packages.sh "$list")
brought_along=$(./run fresh --suite "$suite" tests/fresh/packages.sh "$list" --brought-along | sed -n 's/^brought along: //p')

for package in "${packages[@]}"; do
  if grep -qx -- "$package" <<<"$brought_along"; then
    printf '| `%s` | the others bring it along |\n' "$package"
    continue
  fi
  clone_without "$package"
  log=$kept/without_$package.log
  if (cd "$scratch/veldt" && FRESH_CCACHE=$scratch/ccache ./run fresh --suite "$suite" sh -c "$command") >"$log" 2>&1; then
    printf '| `%s` | passes |\n' "$package"
  else
    printf '| `%s` | fails: %s |\n' "$package" "$(first_fault "$log")"
  fi
done
