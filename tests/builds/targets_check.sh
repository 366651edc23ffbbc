#!/bin/bash
# Checks the targets that CONTRIBUTING.md names without running them. The build knows each, with all that it depends on;
# the files and tests that its commands name exist; and builds with other compilers or sanitizers are configured, and
# compile a file with their flags. The target `every_target` compiles them completely.
#
#   tests/builds/targets_check.sh SOURCES BUILD
set -euo pipefail
cd "$1"
build=$2
fail() { echo "targets_check.sh: $1" >&2; exit 1; }

mapfile -t targets < <(sed -n 's/^| `\([a-z_]*\)` |.*/\1/p' CONTRIBUTING.md)
[ ${#targets[@]} -ge 10 ] || fail "the table of CONTRIBUTING.md was not found"
for target in "${targets[@]}"; do
  command=$(ninja -C "$build" -t commands "$target" | tail -n 1) || fail "the target $target is not in the build"
  for word in $command; do
    case $word in "$PWD/tests/"*) [ -e "$word" ] || fail "the target $target needs $word, which does not exist" ;; esac
  done
  tests=$(sed -n 's/.*hemitex_tests "\?\(\[[^]]*\]\).*/\1/p' <<<"$command")
  if [ -n "$tests" ] && "$build/bin/hemitex_tests" --list-test-names-only "$tests" >/dev/null; then
    fail "the target $target runs $tests, and no test has this tag"  # the exit code is the number of tests
  fi
done

presets=(asan tsan)
if command -v clang++ >/dev/null; then presets+=(fuzz); fi
for preset in "${presets[@]}"; do
  cmake --preset "$preset" --log-level=WARNING
  cmake --build --preset "$preset" --target "$PWD/radiosity/scene/load_scene.cpp^"  # its object file
done
