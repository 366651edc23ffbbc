# Draws a hemicube of 64 x 64 pixels over the floor and sums delta.py over its pixels, surface by surface.
cd "$(dirname "$0")" || exit 2
. ../begin.sh
box=$data/cornell-box.obj
# This element is so small that it is nearly the point where the hemicube stands.
hemitex formfactors -q "$box" --texels 1 --surface floor=129 --from floor:64,64 --by-surface > expected.csv
hemitex vector export "$box" --texels 1 --eye 276.4,0.01,279.6 --normal 0,1,0 --resolution 64 -o vector > log
hemitex vector render vector -o vector > log
python3 check.py
