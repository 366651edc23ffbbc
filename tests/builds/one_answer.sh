#!/bin/bash
# Tests that all builds give the same results. Draws the whole vector suite with each compiler and level of
# optimization, on 1, 2 and 7 threads, and for aarch64. Compares the hashes of all item IDs with the pinned ones in
# one_answer/vector_suite.txt.
#
#   tests/builds/one_answer.sh                 the whole table, in build/one-answer
#   tests/builds/one_answer.sh --quick BUILD   a subset that is fast enough for a test, in BUILD/one-answer
#
# The vectors of the scenes need radiosity. The whole table computes them with each native compiler. The quick one takes
# those of BUILD/bin/hemitex and builds only the rasterizer, as for aarch64.
# Exit code: 1 if anything differs, 2 if a tool is missing or a build fails.
set -euo pipefail
cd "$(dirname "$0")/../.."
pinned=tests/builds/one_answer/vector_suite.txt

case "${1-} $#" in
  " 0") quick=false folder=build/one-answer ;;
  "--quick 2") quick=true folder=$2/one-answer ;;
  *) echo "usage: tests/builds/one_answer.sh [--quick BUILD]" >&2; exit 2 ;;
esac
mkdir -p "$folder"

missing=()
need() { command -v "$1" >/dev/null || missing+=("$2"); }
need clang++ clang
need aarch64-linux-gnu-g++ g++-aarch64-linux-gnu
need qemu-aarch64-static qemu-user-static
if [ ${#missing[@]} -ne 0 ]; then
  echo "one_answer.sh: install the Debian packages ${missing[*]}" >&2
  exit 2
fi

# Warnings are off, because g++ 12 has false positives at -O3.
build() {  # FOLDER TARGETS COMPILER FLAGS [CMAKE ARGUMENT...]
  cmake -S . -B "$1" -G Ninja -DCMAKE_CXX_COMPILER="$3" -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
    -DCMAKE_CXX_FLAGS_RELEASE="$4 -w" "${@:5}" >"$folder/log" 2>&1 &&
    cmake --build "$1" --target $2 >>"$folder/log" 2>&1 && return
  tail -n 40 "$folder/log" >&2
  echo "one_answer.sh: building $1 failed" >&2
  exit 2
}

export_suite() {  # PROGRAM FOLDER
  rm -rf "$2"
  "$1" -q vector suite -o "$2" >"$folder/log"
}

line() { printf '%-32s %7s  %-16s  %s\n' "$@"; }

differing=0
compare() {  # NAME THREADS COMMAND...
  local found verdict=same
  found=$("${@:3}" || true)
  if ! diff <(echo "$found") "$pinned" >"$folder/diff"; then
    verdict=DIFFERS
    differing=1
  fi
  line "$1" "$2" "$(tail -n 1 <<<"$found" | cut -d' ' -f1)" $verdict
  if [ $verdict = DIFFERS ]; then cat "$folder/diff"; fi
}

runs_here() {  # FLAGS
  [[ $1 != *x86-64-v3* ]] || /lib64/ld-linux-x86-64.so.2 --help 2>/dev/null | grep -q 'x86-64-v3 (supported'
}

native() {  # COMPILER FLAGS
  local variant=$folder/$1${2// /} suite=$scenes
  if ! runs_here "$2"; then
    line "$1 $2" - - "SKIPPED: this CPU lacks x86-64-v3"
    return
  fi
  if $quick; then
    build "$variant" hemitex_suite_hashes "$1" "$2" -DHEMITEX_SOLVER=OFF
  else
    suite=$variant/suite
    build "$variant" "hemitex_suite_hashes hemitex" "$1" "$2"
    export_suite "$variant/bin/hemitex" "$suite"
  fi
  for threads in 1 2 7; do
    compare "$1 $2" $threads "$variant/bin/hemitex_suite_hashes" $threads "$suite"/scene-*
  done
}

aarch64() {  # FLAGS
  local variant=$folder/aarch64$1
  local cross="-DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DHEMITEX_SOLVER=OFF -DHEMITEX_THREADS=OFF"
  build "$variant" hemitex_suite_hashes aarch64-linux-gnu-g++ "$1" $cross -DCMAKE_EXE_LINKER_FLAGS=-static
  compare "aarch64 g++ $1" none qemu-aarch64-static "$variant/bin/hemitex_suite_hashes" 1 "$scenes"/scene-*
}

line build threads suite "against the pinned $(tail -n 1 $pinned | cut -d' ' -f1)"
if $quick; then
  scenes=$folder/scenes
  export_suite "$2/bin/hemitex" "$scenes"
  native clang++ "-O3 -march=x86-64-v3"
  aarch64 -O2
else
  scenes=$folder/g++-O2/suite
  for compiler in g++ clang++; do
    for flags in -O0 -O2 "-O3 -march=x86-64-v3"; do native $compiler "$flags"; done
  done
  for flags in -O0 -O2 -O3; do aarch64 $flags; done
fi
exit $differing
