#!/bin/bash
# Measures how long a program takes from its start to the end of `--version` and `--help`: the mean of 200 runs. The limit
# is 20 ms on a machine without other load.
#
#   tests/benchmarks/kit_start.sh PROGRAM
#
# Exit code: 1 above the limit.
set -euo pipefail
limit=20000  # microseconds
runs=200
failed=0
for option in --version --help; do
  "$1" $option >/dev/null  # loads the file into memory
  begin=${EPOCHREALTIME/[.,]/}
  for ((run = 0; run < runs; ++run)); do "$1" $option >/dev/null; done
  mean=$(((${EPOCHREALTIME/[.,]/} - begin) / runs))
  echo "$option: $((mean / 1000)).$(printf %03d $((mean % 1000))) ms"
  [ $mean -lt $limit ] || failed=1
done
exit $failed
