#!/usr/bin/env bash
# Copies of a minimal Debian as it is before anything is installed, for scripts that source this file. Each is a folder
# below `images`, which later copies leave out.
readonly images=/var/lib/images

copy_machine() { # NAME
  mkdir -p "$images/$1"
  tar --create --one-file-system --exclude=".$images" --exclude=".$PWD" --directory / . |
    tar --extract --directory "$images/$1"
}

# What programs in a copy find of this machine: devices, and packages that apt has fetched.
mount_into() { # NAME
  local folder
  for folder in proc sys dev; do mount --rbind "/$folder" "$images/$1/$folder"; done
  mount --bind /var/cache/apt/archives "$images/$1/var/cache/apt/archives"
}

# NAME=VALUE of how to reach package servers.
network_environment() {
  local name
  for name in {http,https,no}_proxy; do [[ -z ${!name:-} ]] || echo "$name=${!name}"; done
}
