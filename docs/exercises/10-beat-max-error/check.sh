# Solves a room with --max-error, with the options of the file "options" and very finely, and compares the first two
# with the third. The error is the sum of the absolute flux differences of all elements over the flux of all elements.
cd "$(dirname "$0")" || exit 2
. ../begin.sh
for option in $(cat options); do
  case $option in
    --max-error*) echo "--max-error is what you have to beat"; exit 1 ;;
    --texel*|--surface*|--adaptive*) echo "keep the default elements, so that they can be compared"; exit 1 ;;
  esac
done
rm -rf fine goal mine
solve() { hemitex solve -q "$data/pyramid-room.obj" --size 8x8 "$@" > log; }
shots() { python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["shots"])' "$1/solution.json"; }
solve -o fine --patch 2 --resolution 384 --split 0.001 --residual 0.00001 || exit 2
solve -o goal --max-error 0.02 || exit 2
solve -o mine $(cat options) || exit 1
error() {
  awk -F, 'FNR == 1 {next} {flux = $10 * ($11 + $12 + $13)}
    NR == FNR {r[$1, $2, $3] = $11; g[$1, $2, $3] = $12; b[$1, $2, $3] = $13; all += flux; next}
    {own[$1] += $10 * (size($11 - r[$1, $2, $3]) + size($12 - g[$1, $2, $3]) + size($13 - b[$1, $2, $3]))}
    END {for (name in own) {sum += own[name]; if (own[name] > own[worst]) worst = name}
         printf "%.2f %s", 100 * sum / all, worst}
    function size(x) {return x < 0 ? -x : x}' fine/elements.csv "$1/elements.csv"
}
goal_error=$(error goal | cut -d' ' -f1) mine=$(error mine)
mine_error=${mine%% *}
goal_shots=$(shots goal) mine_shots=$(shots mine)
echo "--max-error 0.02: error $goal_error % with $goal_shots shots"
echo "your options: error $mine_error % (goal: not more) with $mine_shots shots (goal: at most 80 %)"
echo "your largest share of the error is on ${mine#* }"
awk "BEGIN {exit $mine_error > $goal_error || $mine_shots > 0.8 * $goal_shots}"
