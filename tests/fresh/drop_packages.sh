#!/usr/bin/env bash
# Drops one package at a time from a list in `run` and reports what then fails: the proof that ./run fresh can fail, and
# that each package is needed. For a fresh machine alone: it removes packages.
#
# usage: ./run fresh [--suite SUITE] tests/fresh/drop_packages.sh LIST COMMAND [PACKAGE…]
#   ./run fresh tests/fresh/drop_packages.sh demo tests/fresh/two_frames.sh
#   ./run fresh tests/fresh/drop_packages.sh test './run test browser' chromium chromium-driver python3-selenium
#
# LIST is one of build, package, demo, test, lint and fuzz; without PACKAGE, all of it. COMMAND is a line for sh. It must pass with
# all packages; then each one is removed with what it alone brought along, COMMAND runs in an empty build/, and a row of
# a table says how it ended. What other packages of the list bring along stays, and nothing is run.
# shellcheck disable=SC2016 # backquotes are Markdown's
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

(($# >= 2)) || { echo "usage: drop_packages.sh LIST COMMAND [PACKAGE…]" >&2 && exit 2; }
command=$2
dropped=("${@:3}")
log=$(mktemp)

source ./run # for its lists
declare -n listed=$1_packages
((${#dropped[@]})) || dropped=("${listed[@]}")

apt() { # ARGS…
  DEBIAN_FRONTEND=noninteractive apt-get --quiet --yes --no-install-recommends -o APT::AutoRemove::RecommendsImportant=0 \
    -o APT::AutoRemove::SuggestsImportant=0 "$@" >"$log" 2>&1 || { cat "$log" >&2 && exit 1; }
}

passes() {
  rm -rf build
  VELDT_NO_INSTALL=1 sh -c "$command" >"$log" 2>&1
}

# The first line of the log that says what is missing.
first_fault() {
  grep -aiE '\berror\b|not found|could not|cannot|fatal|no such file|no module|failed' "$log" |
    grep -avE 'Building|took [0-9]+ s' | head -n 1 | cut -c1-160
}

remove_alone() { # PACKAGE
  apt-mark auto "$1" >/dev/null
  apt autoremove --purge
  ! dpkg-query --show --showformat '${db:Status-Status}' "$1" 2>/dev/null | grep -qx installed
}

row() { # PACKAGE
  if ! remove_alone "$1"; then
    echo "the others bring it along"
  elif passes; then
    echo "passes"
  else
    echo "fails: $(first_fault)"
  fi
}

apt update
apt install ccache "${listed[@]}"
passes || { tail -n 30 "$log" >&2 && echo "drop_packages: \"$command\" fails with all packages" >&2 && exit 1; }
for package in "${dropped[@]}"; do
  printf '| `%s` | %s |\n' "$package" "$(row "$package")"
  apt install "$package"
done
passes || { tail -n 30 "$log" >&2 && echo "drop_packages: \"$command\" fails in the end, with all packages again" >&2 && exit 1; }
