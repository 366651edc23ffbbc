#!/usr/bin/env bash
# Builds the wheel of the Python package, installs it into an environment without network, and runs the first example of
# docs/python.md there. The libraries that it needs lie inside, or in Debian packages that this page names.
#   tests/python/wheel_check.sh FOLDER [WHEEL]
set -euo pipefail
top=$(dirname "$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")")
fail() { echo "wheel_check.sh: $1" >&2; exit 1; }

rm -rf "$1" && mkdir -p "$1"
folder=$(readlink -f "$1")
if [ $# -gt 1 ]; then
  cp "$2" "$folder"
else
  (cd "$folder" && /usr/bin/python3 -m pip wheel -q --no-build-isolation --no-deps "$top")
fi
/usr/bin/python3 -m venv --system-site-packages "$folder/env"
"$folder/env/bin/pip" install -q --no-index "$folder"/hemitex-*.whl

cd "$folder"  # away from the sources
env -u PYTHONPATH -u LD_LIBRARY_PATH env/bin/python - "$top" << 'END'
import doctest
import sys
from pathlib import Path

import hemitex

top, environment = Path(sys.argv[1]), Path(sys.prefix).resolve()
assert environment in Path(hemitex.__file__).resolve().parents, hemitex.__file__
page = (top / "docs/python.md").read_text()
example = page[page.index("## A scene"):page.index("`discretize` chooses")]
test = doctest.DocTestParser().get_doctest(example, {}, "first example", "docs/python.md", 0)
result = doctest.DocTestRunner().run(test)
assert result.attempted > 5 and result.failed == 0, result
hemitex.load_scene(top / "data/cornell-box.obj")
END

page=$(sed -n '/^## Start/,/^## A scene/p' "$top/docs/python.md")
for module in env/lib/python3*/site-packages/hemitex/*.so; do
  needed=$(readelf -d "$module" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
  while read -r library _ file _; do
    [ "$file" != not ] || fail "$module needs $library, which is not installed"
    grep -qxF "$library" <<< "$needed" || continue  # a library of a library comes with its package
    package=$(dpkg -S "$(readlink -f "$file")" "$file" 2>/dev/null | head -n 1 | cut -d: -f1) || true
    case $package in
      libc6 | libstdc++6 | libgcc-s1 | zlib1g) ;;  # every Debian with Python has them
      "") [[ $(readlink -f "$file") == "$folder"/* ]] || fail "$library of $module is in no package: $file" ;;
      *) grep -qwF -- "$package" <<< "$page" || fail "docs/python.md does not name $package, which $module needs" ;;
    esac
  done < <(ldd "$module")
done
echo "The wheel runs"
