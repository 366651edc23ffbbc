#!/usr/bin/env bash
# Gives wrong arrays to the Python module, built with the address and undefined-behaviour sanitizers into build/asan.
#   tests/python/address_sanitizer.sh [CALLS]
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
cmake --preset asan -DHEMITEX_PYTHON=ON -DPython_EXECUTABLE=/usr/bin/python3 --log-level=WARNING
cmake --build --preset asan --target hemitex_core
# Python is no program of the sanitizer: its library comes first, and that of exceptions with it. Python itself leaks.
libraries="$(g++ -print-file-name=libasan.so) $(g++ -print-file-name=libstdc++.so)"
exec env LD_PRELOAD="$libraries" ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 PYTHONMALLOC=malloc \
  LD_LIBRARY_PATH="$PWD/build/asan/lib" PYTHONPATH="$PWD/build/asan/python" HEMITEX_FUZZ="${1:-20000}" \
  HEMITEX_PROGRAM=/bin/false /usr/bin/python3 -m pytest -q -p no:cacheprovider tests/python/wrong_arrays_test.py
