# What all checks begin with: the folder of the scenes, and the last line that they print.
if ! program=$(command -v hemitex); then
  echo "hemitex is not on the PATH; docs/tutorial.md says how to put it there" >&2
  exit 2
fi
data=$(dirname "$program")/../share/hemitex
trap 'if [ $? -eq 0 ]; then echo passed; else echo "not passed yet"; fi' EXIT
