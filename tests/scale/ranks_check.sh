#!/bin/bash
# ranks_check.sh PROGRAM DATA WORK RANKS...: parallel runs with these numbers of ranks have the bytes of one process,
# also if a rank stops for a while, if a run is killed and goes on, and in their errors.
set -u
program=$1 data=$2 work=$3
shift 3
if ! command -v mpirun >/dev/null; then
  echo "skipped: mpirun is not installed (Debian package openmpi-bin)"
  exit 0
fi
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

matrix=(formfactors "$data/cornell-box.obj" --all --by-surface --texels 16 --resolution 64 -q)
large=(formfactors "$data/cornell-box.obj" --all --by-surface --texels 32 --resolution 256 -q)
solve=(solve "$data/cornell-box.obj" --texels 16 --resolution 64 --shots 150 --size 80x60 -q)

# All files of a result, without the times of solution.json.
result_hash() {
  (cd "$1" && sed -E '/"[a-z]*_s": [0-9.e-]+/d' -i solution.json && find . -type f | LC_ALL=C sort | xargs sha256sum) |
    sha256sum | cut -c1-16
}

"$program" "${matrix[@]}" >matrix.csv || fail "formfactors of one process"
"$program" "${solve[@]}" -o alone || fail "solve of one process"
alone=$(result_hash alone)
echo "ranks  formfactors --all  solve"
for ranks in "$@"; do
  mpirun -n "$ranks" "$program" "${matrix[@]}" >"matrix$ranks.csv" || fail "formfactors with $ranks ranks"
  cmp matrix.csv "matrix$ranks.csv" || fail "formfactors with $ranks ranks has other bytes"
  mpirun -n "$ranks" "$program" "${solve[@]}" -o "solved$ranks" || fail "solve with $ranks ranks"
  hash=$(result_hash "solved$ranks")
  [ "$hash" = "$alone" ] || fail "solve with $ranks ranks has other bytes"
  echo "$ranks  $(sha256sum <"matrix$ranks.csv" | cut -c1-16)  $hash"
done

# A rank that stops for a moment is slow, and the others go on.
mpirun -n 3 "$program" "${large[@]}" >slow.csv &
launcher=$!
"$program" "${large[@]}" >fast.csv
last=$(pgrep -P "$launcher" | tail -1)
[ -n "$last" ] && kill -STOP "$last" && sleep 0.5 && kill -CONT "$last"
wait "$launcher" || fail "formfactors with a slow rank"
cmp fast.csv slow.csv || fail "formfactors with a slow rank has other bytes"

# A run that was killed goes on with other ranks. A damaged last row is dropped, rows of other settings are refused.
timeout -s KILL 0.3 "$program" "${large[@]}" -o killed.csv
cp killed.csv.part other.csv.part
printf 'half a row' >>killed.csv.part
mpirun -n 2 "$program" "${large[@]}" -o killed.csv 2>/dev/null || fail "going on after a kill"
cmp fast.csv killed.csv || fail "a run that went on has other bytes"
[ -e killed.csv.part ] && fail "the file of rows was not removed"
"$program" "${matrix[@]}" -o other.csv 2>/dev/null
[ $? = 2 ] || fail "rows of other settings are not refused"

# An error has one message and its exit code.
mpirun -n 3 "$program" solve missing.obj -o missing >/dev/null 2>message
[ $? = 2 ] || fail "the exit code of a missing scene"
[ "$(grep -c 'hemitex: error' message)" = 1 ] || fail "the message of a missing scene is not printed once"
[ "$(mpirun -n 3 "$program" --version | wc -l)" = 1 ] || fail "several ranks print"
ldd "$program" | grep -q libmpi && fail "the program links MPI"
exit $((failures > 0))
