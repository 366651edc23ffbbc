# Compares the printed form factor with the closed form.
cd "$(dirname "$0")" || exit 2
. ../begin.sh
closed=$(hemitex formfactors -q squares.obj --from lower --method analytic --by-surface --texels 1 | grep '^upper,' | cut -d, -f3)
python3 form_factor.py | awk -v closed="$closed" '
  {error = $1 / closed - 1; if (error < 0) error = -error
   printf "form factor %.4f, error %.2f %% (goal: below 0.2 %%)\n", $1, 100 * error; reached = error < 0.002}
  END {exit !reached}'
