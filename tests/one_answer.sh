#!/bin/bash
# One answer everywhere: draws the whole vector suite with every compiler and level of optimization, on 1, 2 and 7
# threads, and for aarch64, and compares the hashes of all words with the pinned ones in one_answer/vector_suite.txt.
#
#   tests/one_answer.sh [--quick]
#
# --quick runs g++ -O0 and clang++ -O2 alone; the vectors of the scenes then come from build/release, as they do for
# aarch64, while a full run makes them anew in every build. Exit code 1 where anything differs, 2 where a tool is missing.
# Debian packages beside those of the build: clang; for a full run also g++-aarch64-linux-gnu and qemu-user-static.
set -euo pipefail
cd "$(dirname "$0")/.."
pinned=tests/one_answer/vector_suite.txt
folder=build/one-answer
scenes=$folder/scenes

case "$*" in
  "") quick=false ;;
  --quick) quick=true ;;
  *) echo "usage: tests/one_answer.sh [--quick]" >&2; exit 2 ;;
esac

need() {
  if ! command -v "$1" >/dev/null; then
    echo "one_answer.sh: $1 is missing; install the Debian package $2" >&2
    exit 2
  fi
}
need clang++ clang
if ! $quick; then
  need aarch64-linux-gnu-g++ g++-aarch64-linux-gnu
  need qemu-aarch64-static qemu-user-static
fi

build() {  # FOLDER TARGETS [CMAKE ARGUMENT...]
  cmake -S . -B "$1" -G Ninja "${@:3}" >"$folder/log" 2>&1 && cmake --build "$1" --target $2 >>"$folder/log" 2>&1 && return
  tail -n 40 "$folder/log" >&2
  echo "one_answer.sh: building $1 failed" >&2
  exit 2
}

export_suite() {  # PROGRAM FOLDER
  rm -rf "$2"
  mkdir -p "$2"
  "$1" data "$2"
}

differing=0
report() {  # NAME THREADS COMMAND...
  local found
  found=$("${@:3}" || true)
  local verdict=same
  if ! diff <(echo "$found") "$pinned" >"$folder/diff"; then
    verdict=DIFFERS
    differing=1
  fi
  printf '%-32s %7s  %-16s  %s\n' "$1" "$2" "$(tail -n 1 <<<"$found" | cut -d' ' -f1)" "$verdict"
  if [ $verdict = DIFFERS ]; then cat "$folder/diff"; fi
}

run() {  # NAME FOLDER SCENES [EMULATOR...]
  for threads in 1 2 7; do
    report "$1" $threads "${@:4}" "$2/bin/hemitex_suite_hashes" $threads "$3"/scene-*
  done
}

native() {  # COMPILER FLAGS
  local name="$1 $2"
  local variant=$folder/${name//[ =]/_}
  local arguments=(-DCMAKE_CXX_COMPILER="$1" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="$2")
  if $quick; then
    build "$variant" hemitex_suite_hashes "${arguments[@]}" -DHEMITEX_SOLVER=OFF
    run "$name" "$variant" "$scenes"
  else
    build "$variant" "hemitex_suite_hashes hemitex_suite" "${arguments[@]}"
    export_suite "$variant/bin/hemitex_suite" "$variant/suite"
    run "$name" "$variant" "$variant/suite"
  fi
}

aarch64() {  # FLAGS
  local variant="$folder/aarch64_$1"
  build "$variant" hemitex_suite_hashes -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 \
    -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="$1" \
    -DCMAKE_EXE_LINKER_FLAGS=-static -DHEMITEX_SOLVER=OFF -DHEMITEX_THREADS=OFF
  run "aarch64 g++ $1" "$variant" "$scenes" qemu-aarch64-static
}

mkdir -p "$folder"
build build/release hemitex_suite --preset release
export_suite build/release/bin/hemitex_suite "$scenes"
printf '%-32s %7s  %-16s  %s\n' build threads suite "against the pinned $(tail -n 1 $pinned | cut -d' ' -f1)"
native g++ -O0
if ! $quick; then
  native g++ -O2
  native g++ "-O3 -march=x86-64-v3 -Wno-stringop-overflow"  # g++ 12 misreads Boost.Multiprecision there
  native clang++ -O0
fi
native clang++ -O2
if ! $quick; then
  native clang++ "-O3 -march=x86-64-v3"
  aarch64 -O0
  aarch64 -O2
  aarch64 -O3
fi
exit $differing
