# Compares the radiosity of solve.py with that of shooting, which never builds the matrix.
cd "$(dirname "$0")" || exit 2
. ../begin.sh
room=$data/paper-room.obj
settings="--texels 1 --split 0.001"
hemitex formfactors -q "$room" $settings --all --by-surface > form-factors.csv
hemitex solve -q "$room" $settings --residual 0.000001 --size 8x8 -o lit > log
python3 solve.py form-factors.csv > radiosity.csv || exit 1
awk -F, 'FNR == 1 && NR == 1 {next} NR == FNR {shot[$1] = $11; n += 1; next}
  {e = $2 / shot[$1] - 1; e = e < 0 ? -e : e; if (e > worst) {worst = e; name = $1}; n -= 1}
  END {printf "surfaces without a value: %d, largest error of the radiosity %.1f %% (goal: below 2 %%), of %s\n", n, 100 * worst, name
       exit n != 0 || worst >= 0.02}' lit/elements.csv radiosity.csv
