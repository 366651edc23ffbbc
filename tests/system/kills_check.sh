#!/usr/bin/env bash
# Kills runs with SIGKILL at random moments, goes on, and compares the result with that of a run that was not killed.
# After each kill the folder of the result holds an earlier complete result or none that claims to be complete. A run
# that ends before its signal is compared at once, and the next one begins anew.
# usage: kills_check.sh PROGRAM DATA WORK KILLS [KIND...]
set -euo pipefail
program=$1 data=$2 work=$3 kills=$4
shift 4
kinds=("$@")
[ ${#kinds[@]} -gt 0 ] || kinds=(solve max-error adaptive lightmap edits watch matrix ranks)
rm -rf "$work" && mkdir -p "$work" && cd "$work"
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
RANDOM=1
echo '{"frames": [[{"move": "pyramid*", "by": [5, 0, 5]}], [{"emission": "light", "to": [9, 9, 9]}]]}' >moves.json

scene=$data/pyramid-room.obj
solve=(solve "$scene" --texels 8 --patch 2 --resolution 64 --residual 1e-4 --size 40x30 -q)

# Prints the words of the command of a kind that writes into the folder $2.
command_of() {
  local checkpoint=(--checkpoint checkpoint --every 0.001)
  [ ! -e checkpoint ] || checkpoint+=(--resume checkpoint)
  local words
  case $1 in
    solve) words=("${solve[@]}" "${checkpoint[@]}" -o "$2") ;;
    max-error) words=(solve "$scene" --texels 8 --max-error 0.02 --size 40x30 -q "${checkpoint[@]}" -o "$2") ;;
    adaptive)
      words=(solve "$scene" --texels 16 --adaptive 0.001 --resolution 64 --size 40x30 -q "${checkpoint[@]}" -o "$2")
      ;;
    lightmap) words=("${solve[@]}" --lightmap --report "${checkpoint[@]}" -o "$2") ;;
    edits) words=("${solve[@]}" --edits moves.json "${checkpoint[@]}" -o "$2") ;;
    watch) words=(watch "${solve[@]:1}" -o "$2") ;;
    matrix | ranks)
      words=(formfactors "$scene" --all --facets --texels 16 --resolution 256 -q -o "$2/F.npz")
      ;;
  esac
  printf '%s\0' "${words[@]}"
}

# Starts a run of a kind, and sets `run` to its process.
start() {
  local words
  mapfile -d '' words < <(command_of "$1" "$2")
  if [ "$1" = ranks ]; then
    mpirun -n 3 "$program" "${words[@]}" &
  else
    "$program" "${words[@]}" &
  fi
  run=$!
}

# Waits for the end of a run. A watch ends by a signal, when it has shown its solution.
finish() {
  if [ "$1" = watch ]; then
    until grep -q '"shown"' "$2/watch.js" 2>/dev/null && [ "$2/watch.js" -nt started ]; do
      kill -0 "$run" || return 1
      sleep 0.02
    done
    kill -TERM "$run"
    wait "$run" || [ $? = 143 ]
  else
    wait "$run"
  fi
}

kill_run() {  # returns 1 if it has ended
  if [ "$1" = ranks ]; then  # two ranks of three
    mapfile -t ranks < <(pgrep -P "$run")
    [ ${#ranks[@]} -ge 3 ] || return 1
    kill -KILL "${ranks[1]}" "${ranks[2]}" || return 1
  else
    kill -KILL "$run"
  fi
}

# A folder that says it is complete is so.
check_intact() {
  if [ -e "$1/solution.json" ]; then
    python3 - "$1" <<'END'
import hashlib, json, os, sys
folder = sys.argv[1]
for name, hash in json.load(open(os.path.join(folder, 'solution.json')))['files'].items():
    found = hashlib.sha256(open(os.path.join(folder, name), 'rb').read()).hexdigest()
    assert hash in (None, found), name
END
  fi
  if [ -e "$1/F.json" ]; then
    [ "$(sed -n 's/.*"sha256": "\(.*\)".*/\1/p' "$1/F.json")" = "$(sha256sum <"$1/F.npz" | cut -c1-64)" ]
  fi
}

# The times of solution.json and of pages differ.
compare() {
  diff <(cd whole && find . -name solution.json -exec grep -hv '_s"' {} +) \
    <(cd pieces && find . -name solution.json -exec grep -hv '_s"' {} +)
  diff --recursive --exclude solution.json --exclude report.html --exclude watch.js whole pieces
}

for kind in "${kinds[@]}"; do
  if [ "$kind" = ranks ] && ! command -v mpirun >/dev/null; then
    echo "ranks: skipped, mpirun is not installed"
    continue
  fi
  rm -rf whole pieces checkpoint
  touch started
  from=$(date +%s%N)
  start "$kind" whole
  finish "$kind" whole
  milliseconds=$((($(date +%s%N) - from) / 1000000 + 50))
  rm -f checkpoint
  ends=0
  for ((killed = 0; killed < kills;)); do
    touch started
    start "$kind" pieces
    moment=$((RANDOM % milliseconds))
    sleep "$((moment / 1000)).$(printf %03d $((moment % 1000)))"
    if [ "$kind" != watch ] && ! kill -0 "$run" || ! kill_run "$kind"; then
      wait "$run" || true
      compare
      rm -rf checkpoint pieces
      ends=$((ends + 1))
      milliseconds=$((milliseconds * 4 / 5 + 1)) # runs have become faster than the first one
      continue
    fi
    killed=$((killed + 1))
    wait "$run" || true
    check_intact pieces
  done 2>/dev/null
  touch started
  start "$kind" pieces
  finish "$kind" pieces
  compare
  ls -A pieces | grep -e '^\.hemitex' -e 'part$' && exit 1
  echo "$kind: $kills kills, and $ends runs that ended before: the result is that of a run without one"
done
