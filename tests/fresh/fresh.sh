#!/usr/bin/env bash
# Runs a command in a clone of HEAD on a minimal Debian, which sees of this machine only how to reach apt's and pip's
# registries. `./run fresh` calls it as root, from the root of the repository, once debootstrap is installed.
#
# usage: fresh.sh SUITE USER COMMAND…      SUITE: bookworm or trixie; USER: root, or ranger, who has sudo
#
# build/fresh/SUITE keeps what makes the second time quick: base/, as debootstrap leaves it, and archives/, the packages
# that apt has fetched. root/ is a copy of base/ that lives as long as one run. All mounts are in a mount namespace of
# their own: they end with the last process in it, whatever ends that.
set -euo pipefail

readonly suite=$1 user=$2 inner_command=("${@:3}")
readonly kept=$PWD/build/fresh/$suite
readonly root=$kept/root
home=/root
[[ $user == root ]] || home=/srv/$user
readonly home

main() {
  mkdir -p "$kept/archives/partial"
  exec 9>"$kept/lock"
  flock --nonblock 9 || fail "another ./run fresh is at work in $kept"
  trap remove_root EXIT
  trap 'exit 130' INT
  trap 'exit 143' TERM HUP
  remove_root
  timed "base system, kept" make_base
  timed "copy and clone" make_root
  timed "${inner_command[*]}" run_inside
  record_pass
}

fail() { # LINE
  printf 'fresh: %s\n' "$1" >&2
  exit 1
}

# Fails where COMMAND fails, whatever `set -e` finds inside it.
timed() { # NAME COMMAND…
  local start=$SECONDS
  "${@:2}"
  printf '== fresh %s: %s took %d s\n' "$suite" "$1" $((SECONDS - start))
}

# Ends what still runs inside; no mount is left to be seen from here.
remove_root() {
  [[ -z ${inside:-} ]] || kill -KILL "$inside" 2>/dev/null || true
  [[ -z ${inside:-} ]] || wait "$inside" 2>/dev/null || true
  rm -rf --one-file-system "$root"
}

# --- the base system --------------------------------------------------------------------------------------------------

# "URI RELEASE" of every Debian repository this machine uses, with SUITE's releases in place of its own.
repositories() {
  local own
  own=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
  # shellcheck disable=SC2016 # apt-get replaces these
  apt-get indextargets --format '$(REPO_URI) $(RELEASE)' 'Created-By: Packages' 'Origin: Debian' 'Component: main' |
    sort -u | sed "s/ $own\b/ $suite/"
}

# debootstrap's own mirror where this machine uses none of Debian's.
make_base() {
  local mirror
  [[ ! -d $kept/base ]] || return 0
  mirror=$(repositories | awk -v suite="$suite" '$2 == suite {print $1; exit}')
  rm -rf --one-file-system "$kept/base.part"
  # shellcheck disable=SC2086 # no mirror, no argument
  debootstrap --variant=minbase "$suite" "$kept/base.part" $mirror >"$kept/debootstrap.log" 2>&1 ||
    fail "debootstrap failed; $kept/debootstrap.log says why"
  mv "$kept/base.part" "$kept/base"
}

# --- one run's root ---------------------------------------------------------------------------------------------------

make_root() {
  cp --archive --reflink=auto "$kept/base" "$root"
  copy_network_settings
  allow_no_services
  [[ $user == root ]] || add_user
  mkdir -p "$root$home"
  git -c safe.directory='*' clone --quiet --no-hardlinks "file://$PWD" "$root$home/veldt"
  [[ $user == root ]] || chroot "$root" chown -R "$user:" "$home"
}

# Where apt and pip find their registries, and the certificates they trust.
copy_network_settings() {
  local found
  found=$(repositories)
  [[ -z $found ]] || sed 's/^/deb /; s/$/ main/' <<<"$found" >"$root/etc/apt/sources.list"
  apt-config dump Acquire | grep -v IndexTargets >"$root/etc/apt/apt.conf.d/00host" || true
  [[ -z ${http_proxy:-} ]] || echo "Acquire::http::Proxy \"$http_proxy\";" >>"$root/etc/apt/apt.conf.d/00host"
  cp --recursive --no-target-directory /etc/apt/auth.conf.d "$root/etc/apt/auth.conf.d" 2>/dev/null || true
  cp /etc/pip.conf "$root/etc/" 2>/dev/null || true
  cp --dereference /etc/resolv.conf /etc/hosts "$root/etc/"
  mkdir -p "$root/usr/share/host-certificates"
  cp --dereference /etc/ssl/certs/ca-certificates.crt "$root/usr/share/host-certificates/" 2>/dev/null || true
}

# Packages must not start daemons there. What dpkg writes need not outlive a power cut.
allow_no_services() {
  printf '#!/bin/sh\nexit 101\n' >"$root/usr/sbin/policy-rc.d"
  chmod +x "$root/usr/sbin/policy-rc.d"
  echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe-io"
}

add_user() {
  chroot "$root" useradd --create-home --home-dir "$home" --shell /bin/bash "$user"
  mkdir -p "$root/etc/sudoers.d"
  echo "$user ALL=(ALL) NOPASSWD: ALL" >"$root/etc/sudoers.d/$user"
}

# --- inside -----------------------------------------------------------------------------------------------------------

# If this script is killed, so is unshare, and with it everything inside.
run_inside() {
  local status=0
  export suite user root home kept
  export -f mount_devices inner_environment install_sudo enter
  setpriv --pdeathsig KILL unshare --mount --pid --ipc --uts --fork --kill-child -- \
    bash -c 'set -euo pipefail; enter "$@"' enter "${inner_command[@]}" <&0 9>&- &
  inside=$!
  wait "$inside" || status=$?
  inside=
  return $status
}

mount_devices() {
  local device
  mount -t proc proc "$root/proc"
  mount --rbind --make-rslave /sys "$root/sys"
  mount -t tmpfs -o mode=755 dev "$root/dev"
  for device in null zero full random urandom tty; do
    : >"$root/dev/$device"
    mount --bind "/dev/$device" "$root/dev/$device"
  done
  mkdir "$root/dev/pts" "$root/dev/shm"
  mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts"
  mount -t tmpfs -o mode=1777 shm "$root/dev/shm"
  ln -s pts/ptmx "$root/dev/ptmx"
  ln -s /proc/self/fd "$root/dev/fd"
  ln -s fd/0 "$root/dev/stdin"
  ln -s fd/1 "$root/dev/stdout"
  ln -s fd/2 "$root/dev/stderr"
  mount --bind "$kept/archives" "$root/var/cache/apt/archives"
}

# NAME=VALUE of everything the command finds in its environment.
inner_environment() {
  local name certificates=/usr/share/host-certificates/ca-certificates.crt
  printf '%s\n' "HOME=$home" "USER=$user" "LOGNAME=$user" "TERM=${TERM:-dumb}" \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin
  [[ ! -e $root$certificates ]] || echo "PIP_CERT=$certificates"
  for name in {http,https,no,all}_proxy PIP_{INDEX_URL,EXTRA_INDEX_URL,TRUSTED_HOST,PROXY,DEFAULT_TIMEOUT}; do
    [[ -z ${!name:-} ]] || echo "$name=${!name}"
  done
}

install_sudo() { # a variable `environment`
  # shellcheck disable=SC2154 # set by enter
  chroot "$root" env -i DEBIAN_FRONTEND=noninteractive "${environment[@]}" \
    sh -c "apt-get -q update && apt-get -q -y --no-install-recommends install sudo" >"$kept/sudo.log" 2>&1
}

enter() { # COMMAND…
  local environment
  mount --make-rprivate /
  mount_devices
  hostname localhost
  mapfile -t environment < <(inner_environment)
  [[ $user == root ]] || install_sudo
  chroot "$root" setpriv --reuid "$user" --regid "$user" --init-groups env -i "${environment[@]}" \
    sh -c 'cd ~/veldt && exec "$@"' sh "$@"
}

# After a run that built the program and made two frames, build/fresh/passed holds the hash of the tree it ran on.
record_pass() {
  local clone=$root$home/veldt frames
  [[ -d $clone/build ]] || return 0
  frames=$(find "$clone/build" -path '*/ir8/*.png' | wc -l)
  [[ -x $clone/build/release/bin/veldt ]] && ((frames >= 2)) || return 0
  git -c safe.directory='*' -C "$clone" rev-parse 'HEAD^{tree}' >build/fresh/passed
  echo "== fresh $suite: built and made $frames frames; build/fresh/passed has this tree's hash"
}

main
