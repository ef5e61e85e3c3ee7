#!/usr/bin/env bash
# Builds the Debian packages and uses them on a machine that has nothing else of ours: a copy of this one from before
# anything was installed here. apt alone finds what `veldt` depends on; an ordinary user makes frames, reads the manual and
# completes a command; then the package is purged, and nothing of it is left.
#
# Run it on a minimal Debian as root, where nothing else was installed before: ./run fresh tests/fresh/package.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/fresh/copies.sh

readonly user=ranger machine=$images/package
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

fail() { # LINE
  printf 'package: %s\n' "$1" >&2
  exit 1
}

timed() { # NAME COMMAND…
  local start=$SECONDS
  "${@:2}"
  printf '== package: %s took %d s\n' "$1" $((SECONDS - start))
}

# --- the other machine ------------------------------------------------------------------------------------------------

# In a folder where an ordinary user may not write.
inside() { # USER COMMAND…
  local network
  mapfile -t network < <(network_environment)
  chroot --userspec="$1:$1" --groups="$1" "$machine" env -i "HOME=$(getent_home "$1")" PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "${network[@]}" sh -c 'cd /usr && exec "$@"' sh "${@:2}"
}

getent_home() { # USER
  [[ $1 == root ]] && echo /root || echo "/srv/$1"
}

quietly() { # COMMAND…
  "$@" >"$scratch/log" 2>&1 || fail "$* ended with code $?: $(tail -n 20 "$scratch/log")"
}

install_package() {
  mount_into package
  chroot "$machine" useradd --create-home --home-dir "/srv/$user" "$user"
  cp build/package/veldt_*.deb "$machine/srv/veldt.deb"
  quietly inside root apt-get update
  quietly inside root apt-get install --yes --no-install-recommends /srv/veldt.deb
  quietly inside root apt-get install --yes --no-install-recommends man-db bash-completion
}

# Everything but what the user makes.
files() {
  inside root find / -xdev -path "/srv/$user" -prune -o -path /srv/veldt.deb -o -print | sort
}

# --- use --------------------------------------------------------------------------------------------------------------

# By the model that needs no maps of the ground, which take a minute.
make_frames() {
  inside "$user" veldt generate /usr/share/veldt/configs/demo.json --engine embree --out "/srv/$user/demo" \
    --set 'clips[0].frames=1' 'clips[1].frames=1' sensor.preset=airsim_w
  inside "$user" veldt validate "/srv/$user/demo"
  inside "$user" veldt report "/srv/$user/demo"
  inside "$user" veldt video "/srv/$user/demo" --out "/srv/$user/demo.png" --boxes --scale
  [[ $(find "$machine/srv/$user/demo/clips" -path '*/ir8/*.png' | wc -l) == 2 ]] || fail "there are not two frames"
  [[ -s $machine/srv/$user/demo/report.html && -s $machine/srv/$user/demo.png ]] || fail "a report or a picture is missing"
}

check_manual() {
  local page
  while read -r page; do
    inside "$user" man --where "$page" >/dev/null || fail "man finds no page $page"
  done < <(inside "$user" veldt --help | sed -n 's/^  \([a-z]\+\)    .*/veldt-\1/p')
  inside "$user" man veldt | grep -q '^EXIT STATUS' || fail "man veldt shows no exit status"
}

# As bash-completion does when somebody presses Tab: its default loads the file, which then knows the choices.
check_completion() {
  local found
  # shellcheck disable=SC2016 # the inner shell replaces these
  found=$(inside "$user" bash -c 'source /usr/share/bash-completion/bash_completion
    load=$(complete -p -D | sed "s/.*-F \([^ ]*\).*/\1/")
    COMP_WORDS=(veldt generate --engine "") COMP_CWORD=3 COMP_LINE="veldt generate --engine " COMP_POINT=24
    "$load" veldt "" --engine || [[ $? == 124 ]]
    complete -p veldt >/dev/null && _veldt && echo "${COMPREPLY[*]}"')
  [[ $found == "auto blender embree" ]] || fail "completion of --engine offers \"$found\"; expected \"auto blender embree\""
}

# --- removal ----------------------------------------------------------------------------------------------------------

purge_package() {
  quietly inside root apt-get purge --yes veldt
}

# dpkg forgets the package, and no file or folder is named like it.
check_absence() { # LISTED
  local left
  # shellcheck disable=SC2016 # dpkg-query replaces these
  left=$(inside root dpkg-query --show --showformat '${db:Status-Abbrev}${Package}\n' 'veldt*' 2>/dev/null || true)
  [[ -z $left ]] || fail "dpkg still knows $left"
  ! left=$(grep -i veldt "$1") || fail "purging left $left"
}

# The first removal shows the machine with the dependencies alone; whatever use and a second one add is ours.
check_removal() {
  purge_package
  files >"$scratch/before"
  check_absence "$scratch/before"
  quietly inside root dpkg --install /srv/veldt.deb
  use_package
  purge_package
  files >"$scratch/after"
  diff "$scratch/before" "$scratch/after" || fail "installing, using and purging changes which files there are"
}

use_package() {
  inside "$user" veldt doctor
  make_frames
  check_manual
  check_completion
}

# --- the library ------------------------------------------------------------------------------------------------------

# Here, where compilers are: the examples, by what veldt-dev puts where CMake looks.
check_development() {
  quietly apt-get install --yes --no-install-recommends "$PWD"/build/package/veldt-dev_*.deb
  quietly cmake -S tests/examples -B "$scratch/examples" -G Ninja -DCMAKE_BUILD_TYPE=Release
  quietly cmake --build "$scratch/examples"
  quietly ctest --test-dir "$scratch/examples" --output-on-failure
  quietly apt-get purge --yes veldt-dev
}

[[ -d /usr/share/host-certificates ]] || fail "this is not a machine of ./run fresh, and too large to copy"
timed "copy of the machine" copy_machine package
timed "./run package" ./run package
timed "installation by apt" install_package
timed "use and removal" check_removal
timed "programs with veldt-dev" check_development
du --bytes build/package/*.deb
