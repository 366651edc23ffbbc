#!/bin/bash
# Installs the Debian package in a bare Debian and lights the Cornell box there: the program must start, and write what
# the one that was built here writes.
#
#   tests/builds/package_check.sh BUILD   needs root, the Debian package debootstrap, and a mirror of Debian
#
# Exit code: 1 if the package fails, 2 if something is missing here.
set -euo pipefail
build=$(realpath "$1")
work=$build/package_check
root=$work/root
if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap >/dev/null; then
  echo "package_check.sh: run as root, with the Debian package debootstrap installed" >&2
  exit 2
fi
# The dynamic linker reads /proc to know where a program lies. The mount ends with the command.
in_root() { unshare --pid --fork --mount-proc="$root/proc" chroot "$root" "$@"; }

rm -rf "$work"
mkdir -p "$work"

(cd "$build" && cpack -G DEB -B "$work" >"$work/log")
package=$(echo "$work"/hemitex_*.deb)
dpkg-deb --info "$package"

. /etc/os-release
debootstrap --variant=minbase "$VERSION_CODENAME" "$root" >>"$work/log"
cp "$package" "$root/hemitex.deb"
in_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends /hemitex.deb >>"$work/log"

solve=(hemitex --quiet solve)
in_root "${solve[@]}" /usr/share/hemitex/cornell-box.obj -o /cornell-box >/dev/null
"$build/bin/${solve[@]}" "$build/share/hemitex/cornell-box.obj" -o "$work/cornell-box" >/dev/null
for file in elements.csv render.png scene.glb; do
  if ! cmp "$root/cornell-box/$file" "$work/cornell-box/$file"; then
    echo "package_check.sh: the installed program writes another $file" >&2
    exit 1
  fi
done
rm -rf "$root"
echo "package_check.sh: $(basename "$package") works in a bare Debian"
