# Compares the flux of all surfaces after 40 shots with that of a converged solution.
cd "$(dirname "$0")" || exit 2
room=../../../data/paper-room.obj
settings="--texels 1 --split 0.001"
hemitex formfactors -q $room $settings --all --by-surface > form-factors.csv
hemitex solve -q $room $settings --residual 0.000001 --size 8x8 -o lit > log
python3 shoot.py form-factors.csv lit/elements.csv 40 > radiosity.csv || exit 1
awk -F, 'FNR == 1 && NR == 1 {next} $1 == "light" {next} NR == FNR {area[$1] = $10; all += $10 * $11; shot[$1] = $11; next}
  {e = ($2 - shot[$1]) * area[$1]; sum += e < 0 ? -e : e; shot[$1] = 0}
  END {for (name in shot) sum += shot[name] * area[name]
       printf "error of the reflected flux after 40 shots: %.1f %% (goal: below 3 %%)\n", 100 * sum / all
       exit sum >= 0.03 * all}' lit/elements.csv radiosity.csv
