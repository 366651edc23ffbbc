# Exports a test vector, lets the program draw it, and judges each pixel.
cd "$(dirname "$0")" || exit 2
. ../begin.sh
rm -rf vector drawn && mkdir drawn
hemitex vector export "$data/pyramid-room.obj" --texels 8 --eye 2,0.01,2 --normal 0,1,0 --resolution 32 -o vector > log
sh draw.sh vector drawn || exit 1
hemitex vector check vector --candidate drawn > verdict.txt
result=$?
head -n 7 verdict.txt
exit $result
