# Lights the Cornell box with the options of the file "options", and compares a picture of its elements with a fine one.
cd "$(dirname "$0")" || exit 2
. ../begin.sh
rm -rf fine mine
light() {
  folder=$1; shift
  hemitex solve -q "$data/cornell-box.obj" "$@" --size 8x8 -o "$folder" > "$folder.log" || exit 1
  hemitex render "$folder/scene.obj" --show elements --exposure 0.4 --size 320x240 -o "$folder.png" || exit 1
}
light fine --texels 32
light mine $(cat options)
elements=$(grep -c . mine/elements.csv); elements=$((elements - 1))
idiff fine.png mine.png | awk -v elements=$elements '
  /Mean error/ {printf "%d elements (goal: at most 750), mean error of the picture %.2f %% (goal: at most 0.4 %%)\n", elements, 100 * $4
                reached = elements <= 750 && $4 <= 0.004}
  /Max error/ {print "worst pixel: " substr($0, index($0, "@") + 2)}
  END {exit !reached}'
