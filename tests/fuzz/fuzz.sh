#!/bin/bash
# Runs harnesses with libFuzzer, as many at a time as there are cores, and prints a table of executions and findings.
#
#   tests/fuzz/fuzz.sh OPTIONS FOLDER NAME=HARNESS...
#
# OPTIONS are those of libFuzzer that end a run, such as -max_total_time=60. FOLDER keeps the inputs that reached new
# code for the next run, the logs, and the inputs of findings.
# Exit code: 1 if anything was found, or a harness did not run to its end.
set -euo pipefail
seeds=$(dirname "$(readlink -f "$0")")/seeds
options=$1 folder=$2
shift 2
mkdir -p "$folder"/{corpus,logs,findings}
TMPDIR=$(mktemp -d -p /dev/shm hemitex-fuzz-XXXXXX)  # files in memory: on a disk, harnesses run ten times slower
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT

fuzz() {  # NAME=HARNESS
  local name=${1%%=*} harness=${1#*=} length=4096 sanitizer=detect_leaks=1 limits
  case $name in
    # OpenImageIO is not instrumented, leaks, and takes 64 MiB per image, which the sanitizer would mark each time.
    png | jpeg | exr) length=16384 sanitizer=detect_leaks=0:poison_heap=0:quarantine_size_mb=1 ;;
    gltf) length=16384 sanitizer=detect_leaks=0 ;;
    solution) sanitizer=detect_leaks=0 ;;
  esac
  read -ra limits <<<"$options"
  mkdir -p "$folder/corpus/$name"
  # The bookkeeping of the entropic schedule takes longer than most inputs.
  ASAN_OPTIONS=$sanitizer "$harness" "${limits[@]}" -entropic=0 -timeout=20 -report_slow_units=20 \
    -rss_limit_mb=3000 -max_len=$length -print_final_stats=1 -artifact_prefix="$folder/findings/$name-" \
    "$folder/corpus/$name" "$seeds/$name" >"$folder/logs/$name" 2>&1 || true
  local runs took found
  read -r runs took <<<"$(sed -n 's/^Done \([0-9]*\) runs in \([0-9]*\) second.*/\1 \2/p' "$folder/logs/$name")"
  found=$(find "$folder/findings" -name "$name-*" | wc -l)
  printf '%-14s %12s %8s %10s\n' "$name" "${runs:--}" "${took:--}" "$found"
  if [ "$found" -gt 0 ] || [ -z "$runs" ]; then tail -n 40 "$folder/logs/$name" >&2; return 1; fi
}
export -f fuzz
export seeds options folder
printf '%-14s %12s %8s %10s\n' harness executions seconds findings
printf '%s\0' "$@" | xargs -0 -n 1 -P "$(nproc)" bash -c 'set -euo pipefail; fuzz "$1"' fuzz
