#!/bin/bash
# Runs harnesses with libFuzzer, as many at a time as there are cores, and prints a table of executions and findings.
#
#   tests/fuzz/fuzz.sh SECONDS FOLDER NAME=HARNESS...
#
# FOLDER keeps the inputs that reached new code for the next run, the logs, and the inputs of findings.
# Exit code: 1 if anything was found.
set -euo pipefail
seeds=$(dirname "$(readlink -f "$0")")/seeds
seconds=$1 folder=$2
shift 2
mkdir -p "$folder"/{corpus,logs,findings}

fuzz() {  # NAME=HARNESS
  local name=${1%%=*} harness=${1#*=} length=4096 leaks=1
  case $name in
    gltf) length=16384 ;;
    png | jpeg | exr) length=16384 leaks=0 ;;  # libpng leaves functions of OpenImageIO by longjmp, which loses strings
  esac
  mkdir -p "$folder/corpus/$name"
  ASAN_OPTIONS=detect_leaks=$leaks "$harness" -max_total_time="$seconds" -timeout=20 -report_slow_units=20 \
    -rss_limit_mb=3000 -max_len=$length -print_final_stats=1 -artifact_prefix="$folder/findings/$name-" \
    "$folder/corpus/$name" "$seeds/$name" \
    >"$folder/logs/$name" 2>&1 || true
  local executions took
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$folder/logs/$name" | tail -n 1)
  took=$(sed -n 's/^Done [0-9]* runs in \([0-9]*\) second.*/\1/p' "$folder/logs/$name")
  printf '%-14s %12s %8s %10s\n' "$name" "${executions:--}" "${took:--}" \
    "$(find "$folder/findings" -name "$name-*" | wc -l)"
}
export -f fuzz
export seeds seconds folder
printf '%-14s %12s %8s %10s\n' harness executions seconds findings
printf '%s\0' "$@" | xargs -0 -n 1 -P "$(nproc)" bash -c 'fuzz "$1"' fuzz
[ -z "$(ls "$folder/findings")" ]
