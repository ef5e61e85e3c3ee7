#!/usr/bin/env bash
# Replays Dockerfile without Docker, instruction by instruction, and uses the image as `docker run` would. Run it on a
# minimal Debian 13 as root, which stands in for debian:trixie-slim: ./run fresh --container
#
# A stage is a copy of this machine in a folder of its own. An instruction that is not known here is an error, so that
# all those of Dockerfile are tried.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/fresh/copies.sh

readonly path=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin

fail() { # LINE
  printf 'container: %s\n' "$1" >&2
  exit 1
}

# --- stages -----------------------------------------------------------------------------------------------------------

start_stage() { # IMAGE [AS NAME]
  local name=${3:-final}
  [[ $1 == "debian:$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)-slim" ]] || fail "this machine is not $1"
  stage=$images/$name
  environment=("PATH=$path")
  user=0:0
  workdir=/
  cp --archive "$images/base" "$stage"
  mount_into "$name"
}

# The environment of a step has HOME unless the image sets it, and how to reach package servers.
inside() { # COMMAND…
  local outside
  mapfile -t outside < <(network_environment)
  # shellcheck disable=SC2016 # the inner shell replaces these
  chroot --userspec="$user" --groups= "$stage" env -i HOME=/ "${outside[@]}" "${environment[@]}" \
    sh -c 'cd "$0" && exec "$@"' "$workdir" "$@"
}

# What .dockerignore leaves of this folder: it ignores everything but the names after an exclamation mark.
copy_context() { # TARGET
  local names
  mapfile -t names < <(sed -n 's/^!//p' .dockerignore)
  [[ $(grep -v '^[#!]' .dockerignore) == '*' ]] || fail ".dockerignore has a pattern that is not known here"
  cp --archive --target-directory "$stage$workdir/$1" "${names[@]}"
}

copy() { # [--from=STAGE] SOURCE TARGET
  if [[ $1 == --from=* ]]; then
    mkdir -p "$(dirname "$stage$3")"
    cp --archive --no-target-directory "$images/${1#--from=}$2" "$stage$3"
  elif [[ $1 == . ]]; then
    copy_context "$2"
  else
    fail "COPY $*; expected . or --from"
  fi
}

# --- instructions -----------------------------------------------------------------------------------------------------

# One a line, without comments.
instructions() {
  sed '/^#/d' Dockerfile | sed ':a; /\\$/ {N; s/\\\n *//; ta}' | grep .
}

replay() { # INSTRUCTION REST
  local words start=$SECONDS
  read -ra words <<<"$2"
  case $1 in
    FROM) start_stage "${words[@]}" ;;
    RUN) inside sh -c "$2" ;;
    COPY) copy "${words[@]}" ;;
    ENV) environment+=("$2") ;;
    USER) user=$2 ;;
    WORKDIR) workdir=$2 && mkdir -p "$stage$2" ;;
    ENTRYPOINT) entry_point=$(sed -n 's/^\["\([^"]*\)"\]$/\1/p' <<<"$2") ;;
    *) fail "$1 is not an instruction that is known here" ;;
  esac
  printf '== container: %s %.60s took %d s\n' "$1" "$2" $((SECONDS - start))
}

build_image() {
  local lines line
  mapfile -t lines < <(instructions)
  for line in "${lines[@]}"; do replay "${line%% *}" "${line#* }" </dev/null; done
}

# --- use --------------------------------------------------------------------------------------------------------------

# docker run --user USER --volume FOLDER:/data veldt ARGS…
run_container() { # USER FOLDER ARGS…
  local user=$1
  mount --bind "$2" "$stage/data"
  inside "$entry_point" "${@:3}" || fail "$* ended with code $?"
  umount "$stage/data"
}

check_libraries() {
  local missing
  missing=$(inside sh -c 'ldd /usr/local/bin/veldt /usr/local/lib/veldt/*.so' | grep 'not found' || true)
  [[ -z $missing ]] || fail "libraries are missing: $missing"
}

# The demo's two clips, one frame each, with Blender and for a user that the image does not know with Embree.
make_frames() { # USER ENGINE
  local folder=$images/data_$2
  install --directory --owner "${1%:*}" "$folder"
  run_container "$1" "$folder" generate /usr/local/share/veldt/configs/demo.json --engine "$2" --out demo \
    --set 'clips[0].frames=1' 'clips[1].frames=1'
  run_container "$1" "$folder" validate demo
  run_container "$1" "$folder" report demo
  run_container "$1" "$folder" video demo --out demo.mp4 --boxes --scale
  [[ -z $(find "$folder" ! -uid "${1%:*}") ]] || fail "files of $folder do not belong to ${1%:*}"
}

use_image() {
  local empty_home=$images/nothing
  mkdir -p "$empty_home"
  [[ $user != 0* ]] || fail "the image runs as root"
  check_libraries
  run_container "$user" "$empty_home" --version
  run_container "$user" "$empty_home" doctor
  inside bash -c 'veldt --version' # a job of configs/ci
  make_frames "$user" blender
  make_frames 4321:4321 embree
}

copy_machine base
build_image
use_image
echo "== container: $(du --summarize --human-readable --one-file-system "$stage" | cut -f1) in the image"
