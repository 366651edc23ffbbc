# Draws the Cornell box with the offsets, by a clamped add and by an integer add, and counts the pixels that differ.
cd "$(dirname "$0")" || exit 2
. ../begin.sh
rm -rf vector integer
hemitex vector export "$data/cornell-box.obj" --texels 6 --surface floor=10 --surface ceiling=12 --surface light=3 \
  --surface wall-back=15 --eye 278,273,280 --normal 0,1,0 --resolution 64 -o vector > log
cp -r vector integer
python3 check.py || exit 1
hemitex vector render vector -o vector > log && hemitex vector render integer -o integer > log || exit 2
pixels=$(cat vector/top.u32 vector/side-*.u32 | od -An -v -tu4 -w4 > clamped.txt
  cat integer/top.u32 integer/side-*.u32 | od -An -v -tu4 -w4 | paste clamped.txt - | awk '
    $1 != $2 {n += 1; if (n == 1) first = sprintf("; number %d has %d instead of %d", NR, $1, $2)} END {print n + 0 first}')
echo "pixels that the clamp destroys (goal: 0): $pixels"
[ "$pixels" = 0 ]
