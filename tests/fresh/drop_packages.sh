#!/usr/bin/env bash
# Drops one package at a time from the lists in `run` and reports what then fails on a fresh machine: the proof that
# ./run fresh can fail, and that each package is needed. Run by hand as root, after one ./run fresh; a suite takes an
# hour or two.
#
# usage: tests/fresh/drop_packages.sh SUITE COMMAND PACKAGE…
#   tests/fresh/drop_packages.sh bookworm tests/fresh/two_frames.sh g++ cmake ninja-build …
#   tests/fresh/drop_packages.sh bookworm './run test' catch2 python3-pytest …
#
# Prints a table row a package: still installed (as a dependency of the others), or what the command ended with.
# shellcheck disable=SC2016 # backquotes are Markdown's
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

readonly suite=$1 command=$2 packages=("${@:3}")
readonly kept=$PWD/build/fresh/$suite
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$scratch/ccache"

# The names in all lists of `run`, one a line.
listed_packages() {
  sed -n '/^[a-z]*_packages=(/,/)$/p' run | sed 's/^[a-z]*_packages=(//; s/)$//' | tr -s ' ' '\n' | grep -v '^"\|^$' | sort -u
}

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

# Which packages ask for it, of those that the others bring along.
installed_by() { # PACKAGE
  awk -v package="$1" '$1 == "Inst" && $2 == package {found = 1} END {exit !found}' "$scratch/plan"
}

plan_without() { # PACKAGE
  local others
  mapfile -t others < <(listed_packages | grep -vx -- "$1")
  chroot "$kept/base" apt-get --simulate --no-install-recommends install "${others[@]}" >"$scratch/plan" 2>&1
}

for package in "${packages[@]}"; do
  note="" status=0
  clone_without "$package"
  if plan_without "$package" && installed_by "$package"; then note=", though other packages bring it along"; fi
  log=$kept/without_$package.log
  (cd "$scratch/veldt" && FRESH_CCACHE=$scratch/ccache ./run fresh --suite "$suite" sh -c "$command") >"$log" 2>&1 || status=$?
  if ((status == 0)); then
    printf '| `%s` | passes%s |\n' "$package" "$note"
  else
    printf '| `%s` | fails: %s |\n' "$package" "$(grep -aiE 'error|not found|failed|no such' "$log" | head -n 1 | cut -c1-150)"
  fi
done
