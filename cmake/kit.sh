#!/bin/bash
# Writes the kit for authors of backends: an archive with the test vectors and their item IDs, the pages about backends,
# and hemitex-vector, one static program. Equal sources and packages give equal bytes.
#
#   cmake/kit.sh BUILD           for this machine: BUILD/hemitex-vectors-1.tar.gz
#   cmake/kit.sh BUILD aarch64   cross-built: BUILD/hemitex-vectors-1-aarch64.tar.gz; needs g++-aarch64-linux-gnu and,
#                                after `dpkg --add-architecture arm64`, libmd-dev:arm64
#
# BUILD/bin/hemitex writes the vectors. Exit code: 2 if a package is missing or the build fails.
set -euo pipefail
version=1  # of the raster rules and the vectors
packages=(libc6-dev libstdc++-12-dev libboost-dev libcli11-dev libglm-dev libmd-dev libstb-dev nlohmann-json3-dev)

case "$# ${2-}" in
  "1 ") machine="" options=() ;;
  "2 aarch64")
    machine=-aarch64
    options=(-DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++)
    if ! command -v aarch64-linux-gnu-g++ >/dev/null; then
      echo "kit.sh: install the Debian package g++-aarch64-linux-gnu" >&2
      exit 2
    fi
    if ! [ -f /usr/lib/aarch64-linux-gnu/libmd.a ]; then
      echo "kit.sh: dpkg --add-architecture arm64, apt-get update, and install the Debian package libmd-dev:arm64" >&2
      exit 2
    fi ;;
  *) echo "usage: cmake/kit.sh BUILD [aarch64]" >&2; exit 2 ;;
esac
build=$(realpath "$1")
cd "$(dirname "$(readlink -f "$0")")/.."
work=$build/kit$machine
archive=$build/hemitex-vectors-$version$machine.tar.gz
kit=$work/hemitex-vectors-$version
mkdir -p "$work"

# Assertions name their source file: without the prefix map, the folder of the sources would change the bytes.
build_program() {
  cmake -S . -B "$work/build" -G Ninja "${options[@]}" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS_RELEASE="-O2 -ffile-prefix-map=$PWD=." -DHEMITEX_KIT=ON -DHEMITEX_SOLVER=OFF \
    -DCMAKE_UNITY_BUILD=ON -DHEMITEX_THREADS=OFF -DHEMITEX_TESTS=OFF >"$work/log" 2>&1 &&
    cmake --build "$work/build" --target hemitex_vector >>"$work/log" 2>&1 && return
  tail -n 40 "$work/log" >&2
  echo "kit.sh: building hemitex-vector failed" >&2
  exit 2
}

copy_pages() {
  mkdir "$kit/docs"
  cp docs/backend.md docs/faults.md docs/gpu.md docs/item-buffers.md docs/real-gpu.md "$kit/docs"
  local example
  for example in own_backend compute_rasterizer; do
    install -D "examples/$example.cpp" "$kit/examples/$example.cpp"
  done
  local picture
  sed -n 's/.*!\[[^]]*](\([^)]*\)).*/\1/p' docs/backend.md docs/item-buffers.md | while read -r picture; do
    install -D "docs/$picture" "$kit/docs/$picture"
  done
}

# The program contains parts of these packages.
copy_licenses() {
  mkdir "$kit/licenses"
  cp LICENSE "$kit/licenses/hemitex"
  local package
  for package in "${packages[@]}"; do
    if ! cp "/usr/share/doc/$package/copyright" "$kit/licenses/$package"; then
      echo "kit.sh: install the Debian package $package" >&2
      exit 2
    fi
  done
}

build_program
rm -rf "$kit"
mkdir "$kit"
cp "$work/build/bin/hemitex-vector" "$kit"
"$build/bin/hemitex" -q vector suite -o "$kit/vectors" >"$kit/vectors.csv"
copy_pages
copy_licenses
(cd "$kit" && find . -type f ! -name SHA256SUMS -printf '%P\0' | LC_ALL=C sort -z | xargs -0 sha256sum >SHA256SUMS)
tar -C "$work" --sort=name --format=ustar --mtime=2000-01-01T00:00:00Z --owner=0 --group=0 --numeric-owner \
  --mode=u=rwX,go=rX -cf - "$(basename "$kit")" | gzip -n -9 >"$archive.partial"
mv "$archive.partial" "$archive"
echo "$archive"
