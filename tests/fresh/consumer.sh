#!/usr/bin/env bash
# Uses Veldt as a library, the way a project elsewhere does: installs the release build into a temporary folder, copies
# tests/examples beside it, builds them there and compares what they print. Run it after ./run build.
#
# Also checks that every header of the core compiles on its own and shows no third-party library, that programs of the
# core are linked with oneTBB and no other, and that the other components are found and linked.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix

fail() { # LINE
  printf 'consumer: %s\n' "$1" >&2
  exit 1
}

configure_and_build() { # FOLDER
  cmake -S "$1" -B "$1/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wconversion -Werror" >"$work/log" 2>&1 || fail "$(cat "$work/log")"
  cmake --build "$1/build" --verbose >"$work/log" 2>&1 || fail "$(cat "$work/log")"
}

build_examples() {
  cp -r tests/examples "$work"
  configure_and_build "$work/examples"
  check_link_lines
  ctest --test-dir "$work/examples/build" --output-on-failure
}

# The only libraries on link lines are ours and oneTBB.
check_link_lines() {
  local linked others
  linked=$(grep -oE '[^ ]+\.(a|so)[0-9.]*( |$)|(^| )-l[^ ]+' "$work/log" | sort -u)
  others=$(grep -vE '/libveldt_[a-z]+\.a|/libtbb\.so' <<<"$linked" || true)
  grep -q '/libveldt_base\.a' <<<"$linked" || fail "no link line names libveldt_base.a"
  [[ -z $others ]] || fail "the core is linked with $others"
}

# A header of ours includes the standard library, Linux and headers of ours; those of io and above also JSON.
check_includes() {
  local found
  found=$(grep -rnE '^#include' "$prefix/include/veldt" | grep -vE '#include <(veldt/[a-z0-9_/]+\.h|[a-z_0-9]+)>$' |
    grep -vE '/veldt/(io|dataset|analysis)/.*<nlohmann/json\.hpp>$' || true)
  [[ -z $found ]] || fail "installed headers include what they should not: $found"
  [[ $(ls "$prefix/include") == veldt ]] || fail "there is more than veldt/ in $prefix/include"
}

check_headers() { # FOLDER…
  local headers
  mapfile -t headers < <(cd "$prefix/include" && find "${@/#/veldt/}" -name '*.h')
  printf '%s\0' "${headers[@]}" | xargs -0 -P "$(nproc)" -I '{}' \
    "${CXX:-c++}" -std=c++20 -Wall -Wextra -Werror -fsyntax-only -I "$prefix/include" -include '{}' -x c++ /dev/null
  echo "${#headers[@]} headers compile on their own: $*"
}

build_with_files() {
  mkdir "$work/files"
  cat >"$work/files/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(files LANGUAGES CXX)
find_package(veldt 0.1 REQUIRED COMPONENTS io analysis)
add_executable(files files.cpp)
target_link_libraries(files PRIVATE veldt::dataset veldt::analysis)
END
  cat >"$work/files/files.cpp" <<'END'
#include <cstdio>
#include <veldt/analysis/evaluate.h>
#include <veldt/base/error.h>
#include <veldt/dataset/inspect/validate.h>

int main() {
  try {
    (void)thermal::validate_dataset("nowhere");
  } catch (const thermal::IoError& error) {
    return std::puts(error.what()) > 0 && thermal::total({}) == thermal::Counts{} ? 0 : 1;
  }
  return 1;
}
END
  configure_and_build "$work/files"
  "$work/files/build/files"
}

cmake --install build/release --prefix "$prefix" >"$work/log" || fail "$(cat "$work/log")"
build_examples
check_includes
check_headers base radiometry scene sensor labels imaging
build_with_files
