# Compares the flux of all surfaces after 40 shots with that of a converged solution.
cd "$(dirname "$0")" || exit 2
. ../begin.sh
room=$data/paper-room.obj
settings="--texels 1 --split 0.001"
hemitex formfactors -q "$room" $settings --all --by-surface > form-factors.csv
hemitex solve -q "$room" $settings --residual 0.000001 --size 8x8 -o lit > log
python3 shoot.py form-factors.csv lit/elements.csv 40 > radiosity.csv || exit 1
awk -F, 'FNR == 1 && NR == 1 {next} $1 == "light" {next} NR == FNR {area[$1] = $10; all += $10 * $11; shot[$1] = $11; next}
  {add($1, $2 - shot[$1]); shot[$1] = 0}
  END {for (name in shot) if (shot[name] != 0) add(name, -shot[name])
       if (sum > 10 * all) print "after 40 shots there is more than ten times the right flux: what was shot must not be shot again"
       else printf "error of the reflected flux after 40 shots: %.1f %% (goal: below 3 %%), most of it on %s\n", 100 * sum / all, worst
       exit sum >= 0.03 * all}
  function add(name, error) {error *= area[name]; error = error < 0 ? -error : error; sum += error
                             if (error > most) {most = error; worst = name}}' lit/elements.csv radiosity.csv
