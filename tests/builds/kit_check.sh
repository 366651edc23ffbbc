#!/bin/bash
# Tests the kit: builds it, unpacks it into an empty folder, and goes from there to the first verdict. The folder is the
# whole file system of the program, so that it can use no package of this machine.
#
#   tests/builds/kit_check.sh BUILD           the kit of this machine
#   tests/builds/kit_check.sh BUILD aarch64   the cross-built kit, with qemu-user-static
#
# Exit code: 1 if the kit is wrong, 2 if it cannot be built.
set -euo pipefail
maxBytes=$((10 * 1024 * 1024))
build=$(realpath "$1")
cd "$(dirname "$(readlink -f "$0")")/../.."

fail() { echo "kit_check.sh: $*" >&2; exit 1; }

archive=$(cmake/kit.sh "$@")
first=$(sha256sum <"$archive")
cmake/kit.sh "$@" >/dev/null
[ "$first" = "$(sha256sum <"$archive")" ] || fail "the archive changes when it is written again"
[ "$(stat -c %s "$archive")" -lt $maxBytes ] || fail "the archive has 10 MiB or more"

root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
tar -xzf "$archive" -C "$root"
kit=/hemitex-vectors-1
(cd "$root$kit" && sha256sum --quiet --strict --check SHA256SUMS) || fail "the manifest is wrong"
diff <(cut -c 67- "$root$kit/SHA256SUMS") <(cd "$root$kit" && find . -type f ! -name SHA256SUMS -printf '%P\n' |
  LC_ALL=C sort) || fail "the manifest does not list every file"
[ "$(stat -c %s "$root$kit/hemitex-vector")" -lt $maxBytes ] || fail "hemitex-vector has 10 MiB or more"
for page in "$root$kit"/docs/*.md; do
  for link in $(grep -o '\](\([^):#]*\)' "$page" | cut -c 3-); do
    [ -f "$root$kit/docs/$link" ] || fail "$(basename "$page") links $link, which the kit lacks"
  done
done

enter=(chroot "$root")
[ "$(id -u)" -eq 0 ] || enter=(unshare --map-root-user "${enter[@]}")
program=("$kit/hemitex-vector")
if [ "${2-}" = aarch64 ]; then
  cp "$(command -v qemu-aarch64-static)" "$root"
  program=(/qemu-aarch64-static "${program[@]}")
fi
# Every Linux has this device. Here a file takes its place, because only root can make a device.
mkdir "$root/dev"
: >"$root/dev/null"

expect() {  # EXIT_CODE ARGUMENT...
  local code=0
  env -i PATH="$PATH" "${enter[@]}" "${program[@]}" "${@:2}" >"$root/output" 2>&1 || code=$?
  [ $code -eq "$1" ] && return
  cat "$root/output" >&2
  fail "hemitex-vector ${*:2} exits with $code instead of $1"
}
says() { grep -q -e "$1" "$root/output" || { cat "$root/output" >&2; fail "\"$1\" is not in the output"; }; }

expect 0 --version
says "^hemitex-vector [0-9]"
for command in check explain render calibrate random run serve verify; do
  expect 0 $command --help
done

# The first verdict.
vector=$kit/vectors/five-faces
expect 0 render $vector -o /mine/five-faces
cmp "$root$vector/top.u32" "$root/mine/five-faces/top.u32" || fail "render differs from the suite"
expect 0 check $vector --candidate /mine/five-faces
says "^top,[1-9][0-9]*,0,0,0,0,0$"
expect 0 explain $vector --pixel top,8,8
says "^pixel 8,8 of top holds "

# A damaged answer, and its picture with the same pixels as by the other encoder.
printf '\001\002\003\004' | dd of="$root/mine/five-faces/top.u32" conv=notrunc status=none
expect 1 check $vector --candidate /mine/five-faces --diff /diff.png --minimize /small
says "^error in top: "
"$build/bin/hemitex" -q vector check "$root$vector" --candidate "$root/mine/five-faces" --diff "$root/twin.png" \
  >/dev/null && fail "hemitex does not find the damage"
idiff -q "$root/diff.png" "$root/twin.png" || fail "hemitex and hemitex-vector write different pictures"

# The whole suite, random vectors and calibration, with the program as its own device.
device="${program[*]} render {vector} -o {output}"
expect 0 run $kit/vectors --device "$device" -o /suite
says "^all,[1-9][0-9]*,0,0,0,0,0$"
expect 0 run $kit/vectors --device "${program[*]} serve" --lines -o /suite-by-lines --html /page.html
says "^all,[1-9][0-9]*,0,0,0,0,0$"
expect 0 random --seed 0 --count 20 -o /random
expect 0 run /random --device "$device" -o /random-mine
expect 0 run $kit/vectors --device "${program[*]} serve" --lines -o /part --shard 2/9
# Version 2 of the rules: what only its vectors have.
for family in holes culled-sides two-sided triangle-numbers depth-tests viewports; do
  expect 0 random --family $family --seed 0 --count 5 -o /second/$family
  grep -q '"rules": 2' "$root/second/$family/$family-0/vector.json" || fail "$family is not of version 2"
  expect 0 run /second/$family --device "$device" -o /second-mine/$family --exact
  says "^all,[1-9][0-9]*,0,0,0,0,0$"
  says "^reference: agrees with the independent evaluator"
done
expect 0 calibrate --probes /probes
expect 0 run /probes --device "$device" -o /probes-mine
expect 0 calibrate /probes --candidate /probes-mine -o /profile.json --html /profile.html --device-name me
grep -q '<h2>Sub-pixel grid</h2>' "$root/profile.html" || fail "the page of the profile has no sub-pixel grid"
expect 0 check $kit/vectors --candidate /suite --profile /profile.json --record /record.json --device-name a --driver b
expect 0 verify /record.json --suite $kit/vectors --candidate /suite
echo "$archive: $(stat -c %s "$archive") bytes; hemitex-vector: $(stat -c %s "$root$kit/hemitex-vector") bytes"
