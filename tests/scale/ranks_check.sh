#!/bin/bash
# ranks_check.sh PROGRAM DATA WORK RANKS...: parallel runs with these numbers of ranks have the bytes of one process,
# also if a rank stops for a while, if a run is interrupted and goes on with other ranks, and in their errors.
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
large=(formfactors "$data/cornell-box.obj" --all --by-surface --texels 32 --resolution 128 -q)
solve=(solve "$data/cornell-box.obj" --texels 16 --resolution 64 --shots 150 --size 80x60 -q)
# Solutions of about a second: by shots, by growing effort, and with smaller elements.
shots=(solve "$data/cornell-box.obj" --texels 16 --patch 1 --resolution 64 --shots 1500 --size 80x60 -q)
bounded=(solve "$data/paper-room.obj" --texels 8 --max-error 0.002 --size 80x60 -q)
bands=(solve "$data/paper-room.obj" --texels 8 --bands bands.json --resolution 64 --size 80x60 -q)
adaptive=(solve "$data/paper-room.obj" --texels 16 --adaptive 0.0005 --resolution 64 --residual 1e-4 --size 80x60 -q)
endless=(solve "$data/cornell-box.obj" --texels 16 --patch 1 --resolution 64 --residual 1e-300 --size 80x60 -q)

# All files of a result, without the times of solution.json.
result_hash() {
  (cd "$1" && sed -E '/"[a-z]*_s": [0-9.e-]+/d' -i solution.json && find . -type f | LC_ALL=C sort | xargs sha256sum) |
    sha256sum | cut -c1-16
}
# Waits until a command succeeds, for a minute.
until_true() {
  for ((look = 0; look < 6000; ++look)); do
    "$@" && return
    sleep 0.01
  done
  fail "waited in vain for $*"
}
lines() { [ "$(wc -l <"$1")" -ge "$2" ]; } 2>/dev/null
bytes() { [ "$(wc -c <"$1")" -ge "$2" ]; } 2>/dev/null
# Starts a command with a number of ranks, or without mpirun for 1, and sets `run` to its process.
start() {
  local ranks=$1
  shift
  if [ "$ranks" = 1 ]; then
    "$program" "$@" &
  else
    mpirun -n "$ranks" "$program" "$@" 2>>launcher.txt &
  fi
  run=$!
}
# The processes of the ranks of `run`.
processes() { pgrep -P "$run" || echo "$run"; }

echo '{"wavelengths": [450, 500, 550, 600]}' >bands.json
"$program" "${bands[@]}" -o bands1 || fail "solve --bands of one process"
mpirun -n 2 "$program" "${bands[@]}" -o bands2 || fail "solve --bands with 2 ranks"
[ "$(result_hash bands1)" = "$(result_hash bands2)" ] || fail "solve --bands with 2 ranks has other bytes"
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
start 3 "${large[@]}" >slow.csv
"$program" "${large[@]}" >fast.csv
last=$(pgrep -P "$run" | tail -1)
[ -n "$last" ] && kill -STOP "$last" && sleep 0.5 && kill -CONT "$last"
wait "$run" || fail "formfactors with a slow rank"
cmp fast.csv slow.csv || fail "formfactors with a slow rank has other bytes"

# A matrix whose run was killed goes on with other ranks. A damaged last row is dropped, rows of other settings and a
# second run are refused. The first run pauses meanwhile: else it may end before the second one starts.
start 1 "${large[@]}" -o killed.csv
until_true lines killed.csv.part 3
kill -STOP "$run"
"$program" "${large[@]}" -o killed.csv 2>message
[ $? = 2 ] && grep -q 'is in use' message || fail "a second run into one file"
kill -KILL "$run" && wait "$run" 2>/dev/null
cp killed.csv.part other.csv.part
printf 'half a row' >>killed.csv.part
mpirun -n 2 "$program" "${large[@]}" -o killed.csv 2>/dev/null || fail "going on after a kill"
cmp fast.csv killed.csv || fail "a run that went on has other bytes"
[ -e killed.csv.part ] && fail "the file of rows was not removed"
"$program" "${matrix[@]}" -o other.csv 2>/dev/null
[ $? = 2 ] || fail "rows of other settings are not refused"

# stop_and_resume NAME FIRST SECOND COMMAND...: SIGTERM, sent to all ranks of the first run, ends it with its result.
# The second goes on with another number of ranks.
stop_and_resume() {
  local name=$1 first=$2 second=$3
  shift 3
  [ -d "$name" ] || "$program" "$@" -o "$name" || fail "$name"
  rm -rf checkpoint stopped resumed
  start "$first" "$@" -o stopped --checkpoint checkpoint --every 0.05
  until_true bytes checkpoint 1000
  kill -TERM $(processes)
  wait "$run"
  local code=$?
  [ $code = 143 ] || fail "$name with $first ranks: exit code $code after SIGTERM"
  grep -q '"interrupted": true' stopped/solution.json || fail "$name with $first ranks is not interrupted"
  start "$second" "$@" -o resumed --resume checkpoint
  wait "$run" || fail "$name: going on with $second ranks"
  [ "$(result_hash resumed)" = "$(result_hash "$name")" ] ||
    fail "$name: stopped with $first ranks, resumed with $second: other bytes"
}
stop_and_resume shots 3 1 "${shots[@]}"
stop_and_resume shots 1 3 "${shots[@]}"
stop_and_resume bounded 3 2 "${bounded[@]}"
stop_and_resume adaptive 2 3 "${adaptive[@]}"
mpirun -n 2 "$program" solve "$data/paper-room.obj" --texels 4 --method rays --samples 256 --shots 5 --size 8x6 -q \
  -o rays || fail "rays on rank 0 alone"

# A second signal ends all ranks at once.
start 3 "${endless[@]}" -o ended
until_true test -d ended/.hemitex.partial-0
sleep 0.5
kill -TERM $(processes) && kill -TERM $(processes)
wait "$run"
[ $? = 143 ] || fail "the exit code after two signals"
[ -e ended/solution.json ] && fail "a result after two signals"

# An error of any rank has one message and its exit code, and ends all.
mpirun -n 3 "$program" solve missing.obj -o missing >/dev/null 2>message
[ $? = 2 ] || fail "the exit code of a missing scene"
[ "$(grep -c 'hemitex: error' message)" = 1 ] || fail "the message of a missing scene is not printed once"
mpirun -n 1 "$program" "${solve[@]}" -o missing : -n 1 "$program" solve missing.obj -o missing >/dev/null 2>message
[ $? = 2 ] || fail "the exit code of a scene that rank 1 misses"
[ "$(grep -c 'hemitex: error.*missing.obj' message)" = 1 ] || fail "the message of rank 1 is not printed once"
PMI_RANK=0 PMI_SIZE=2 "$program" "${solve[@]}" -o missing >/dev/null 2>message
[ $? = 2 ] || fail "the exit code under a launcher of another MPI"
grep -q "hemitex: error: the launcher's MPI" message || fail "the message under a launcher of another MPI"
PMI_RANK=1 PMI_SIZE=2 "$program" "${solve[@]}" -o missing >/dev/null 2>&1
[ $? = 2 ] || fail "the exit code of rank 1 under a launcher of another MPI"
[ -e missing ] && fail "a result under a launcher of another MPI"
start 3 "${shots[@]}" -o full
until_true test -d full/.hemitex.partial-0
rm -rf launcher.txt full/.hemitex.partial-0
wait "$run"
[ $? = 2 ] || fail "the exit code of a result that cannot be written"
[ "$(mpirun -n 3 "$program" --version | wc -l)" = 1 ] || fail "several ranks print"
ldd "$program" | grep -q libmpi && fail "the program links MPI"

# mpirun answers SIGTERM by SIGTERM to all ranks, and by SIGKILL after the time that is given here.
if [ "$#" -gt 3 ]; then
  OMPI_MCA_odls_base_sigkill_timeout=10 mpirun -n 3 "$program" "${endless[@]}" -o launched 2>/dev/null &
  run=$!
  until_true test -d launched/.hemitex.partial-0
  kill -TERM "$run"
  wait "$run"
  echo "after SIGTERM, mpirun exits with $?"
  grep -q '"interrupted": true' launched/solution.json || fail "SIGTERM to mpirun leaves no result"
fi
exit $((failures > 0))
