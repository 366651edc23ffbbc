#!/bin/bash
# Builds the harnesses of tests/fuzz with clang, and gives each its seeds and some thousand inputs made of them.
#
#   tests/builds/fuzz_check.sh SOURCES
set -euo pipefail
cd "$1"
if ! command -v clang++ >/dev/null; then echo "skipped: clang"; exit 0; fi
cmake --preset fuzz_seeds --log-level=WARNING
cmake --build --preset fuzz_seeds --target fuzz_seeds
