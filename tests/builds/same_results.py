#!/usr/bin/env python3
"""Writes the results of many commands into a folder, without times, so that `diff -r` compares two programs.

    tests/builds/same_results.py OLD/bin/hemitex results/old
    tests/builds/same_results.py NEW/bin/hemitex results/new
    diff -r results/old results/new

Every command runs on every scene of data/. With --quick each kind of result is written for the smallest scenes only.
Results of rays are included: compare them on one machine. Exit code: 1 if a command fails.
"""
import argparse
import hashlib
import json
import pathlib
import re
import shutil
import subprocess
import sys

DATA = pathlib.Path(__file__).resolve().parents[2] / "data"
LARGE = {"gallery", "plant", "curved-room"}

SOLVE = {
    "default": "",
    "packed": "--index-maps packed --shots 100 --filter one-to-one",
    "unique": "--index-maps unique --shots 100 --filter triangle",
    "mesh": "--discretize mesh --shots 100 --filter gouraud --format r10g10b10a2",
    "plane": "--method single-plane --shots 100 --blend integer-add --no-align",
    "tetrahedron": "--method tetrahedron --shots 100 --orientation aligned --format r32ui",
    "outside": "--sky 1,1,2 --sun 1,3,2=4,4,3 --two-sided --shots 50 --no-textures",
    "radiance": "--emission radiance --reflectance *=0.4,0.5,0.6 --shots 100 --split 1 --charts planar",
}
SOLVE_SMALL = {
    "adaptive": "--adaptive 0.001 --filter quadtree",
    "bounded": "--max-error 0.03",
    "rays": "--method rays --samples 4096 --shots 100",
    "detail": "--texels 32 --pixels-per-element 4 --shots 100 --filter bicubic --magnify 2 --no-elements",
    "outside-edits": "--sky 1,1,1 --edits {edits}",
}
ROWS = {
    "row": "--from {surface}:0,0",
    "average": "--from {surface} --method tetrahedron",
    "rays": "--from {surface} --by-surface --method rays --samples 65536",
    "mesh": "--from {surface} --discretize mesh --json",
}
ROWS_SMALL = {
    "matrix": "--all --by-surface",
    "smooth": "--all --by-surface --method single-plane --smooth --json",
    "analytic": "--from {surface} --by-surface --method analytic --texels 2",
    "aimed": "--from {surface} --by-surface --method rays --aimed --samples 64 --texels 2",
}
PICTURES = ["elements", "ids", "index-map", "offsets", "blend-errors", "wireframe", "hemicube", "single-plane",
            "tetrahedron", "map"]


class Runs:
    def __init__(self, program, folder):
        self.program, self.folder, self.failed = program, folder, False

    def run(self, name, command, codes=(0,)):
        """Stores stdout, stderr and the exit code of a command; `{out}` is a folder for its files."""
        out = self.folder / name
        out.mkdir(parents=True)
        words = [word.replace("{out}", str(out)) for word in command]
        done = subprocess.run([self.program, *words], stdin=subprocess.DEVNULL, capture_output=True, text=True)
        (out / "stdout").write_text(without_times(done.stdout, self.folder))
        (out / "stderr").write_text(without_times(done.stderr, self.folder))
        if done.returncode not in codes:
            print(f"{name}: exit code {done.returncode}: {' '.join(words)}\n{done.stderr}", file=sys.stderr)
            self.failed = True

    def render(self, name, vectors):
        """Renders each vector of a folder in place."""
        for vector in sorted(vectors.iterdir()):
            self.run(f"{name}/{vector.name}", ["vector", "render", str(vector), "-o", str(vector)])

    def finish(self):
        """Masks times in JSON files, and replaces large files by their hashes."""
        for file in sorted(self.folder.rglob("*.json")):
            file.write_text(without_times(file.read_text(), self.folder))
        for file in sorted(self.folder.rglob("*")):
            if file.is_file() and file.stat().st_size > 1 << 16:
                digest = hashlib.sha256(file.read_bytes()).hexdigest()
                file.with_name(file.name + ".sha256").write_text(digest + "\n")
                file.unlink()


def without_times(text, folder):
    """JSON without the values of measured times, other text with its seconds masked; `folder` is called RESULTS."""
    text = text.replace(str(folder), "RESULTS")
    try:
        return json.dumps(masked(json.loads(text)), indent=1) + "\n"
    except ValueError:
        return re.sub(r"\b\d+(\.\d+)?(e-?\d+)? (ms|s|min)\b", "TIME", text)


def masked(value):
    if isinstance(value, list):
        return [masked(entry) for entry in value]
    if not isinstance(value, dict):
        return value
    times = re.compile(r"(times|.*_s|.*_ms)$")
    return {key: None if times.match(key) else masked(entry) for key, entry in value.items()}


def first_surface(scene):
    """The first object or group of an OBJ file."""
    return next(line.split()[1] for line in scene.read_text().splitlines() if line.startswith(("o ", "g ")))


def write_scene(runs, scene, quick):
    name, surface = scene.stem, first_surface(scene)
    small = name not in LARGE
    edits = runs.folder / f"{name}-edits.json"
    edits.write_text(json.dumps({"frames": [[{"remove": surface}], [{"restore": surface},
                                                                   {"reflectance": [surface], "to": [.7, .6, .5]}]]}))
    solves = {"default": ""} if quick else {**SOLVE, **(SOLVE_SMALL if small else {})}
    for kind, options in solves.items():
        words = [word.replace("{edits}", str(edits)) for word in options.split()]
        if not small:
            words += ["--shots", "30"] if "--shots" not in words else []
        runs.run(f"{name}/solve-{kind}", ["solve", str(scene), "-o", "{out}/lit", *words])
    rows = {"row": ROWS["row"]} if quick else {**ROWS, **(ROWS_SMALL if small else {})}
    for kind, options in rows.items():
        words = options.replace("{surface}", surface).split()
        runs.run(f"{name}/formfactors-{kind}", ["formfactors", str(scene), *words])
    for show in PICTURES[:2] if quick else PICTURES:
        lit = runs.folder / name / "solve-radiance" / "lit" / "scene.obj"
        shown = lit if show == "elements" and lit.exists() else scene
        if show != "elements" or shown == lit:
            runs.run(f"{name}/render-{show}", ["render", str(shown), "--show", show, "-o", "{out}/picture.png"])
    box = ["--eye", "0.1,0.2,0.3", "--normal", "0,0,1", "--resolution", "64", "--texels", "4"]
    runs.run(f"{name}/vector-export", ["vector", "export", str(scene), *box, "--stages", "-o", "{out}/vector"])


def write_vectors(runs, quick):
    runs.run("vector/suite", ["vector", "suite", "-o", "{out}/suite"])
    suite = runs.folder / "suite"  # with complete files, for the commands below
    subprocess.run([runs.program, "-q", "vector", "suite", "-o", str(suite)], stdout=subprocess.DEVNULL, check=True)
    other = runs.folder / "random"
    runs.run("vector/random", ["vector", "random", "--seed", "7", "--count", "50", "-o", "{out}/random"])
    subprocess.run([runs.program, "-q", "vector", "random", "--seed", "7", "--count", "50", "-o", str(other)],
                   stdout=subprocess.DEVNULL, check=True)
    broken = runs.folder / "broken"  # the suite with the pixels of each face in reverse order
    shutil.copytree(suite, broken)
    for words in sorted(broken.rglob("*.u32")):
        data = words.read_bytes()
        pixels = [data[i:i + 4] for i in range(0, len(data), 4)]
        words.write_bytes(b"".join(reversed(pixels)))
    same = ["vector", "check", str(suite), "--candidate", str(suite)]
    runs.run("vector/check", [*same, "--json", "--junit", "{out}/junit.xml"])
    runs.run("vector/check-exact", [*same, "--exact"], (0, 1))
    check = ["vector", "check", str(suite), "--candidate", str(broken)]
    runs.run("vector/check-broken", check, (0, 1))
    runs.run("vector/check-broken-json", [*check, "--json"], (0, 1))
    face = str(suite / "five-faces")
    runs.run("vector/explain", ["vector", "explain", face, "--pixel", "top,12,3"])
    runs.run("vector/explain-json", ["vector", "explain", face, "--pixel", "top,12,3", "--json"])
    if not quick:
        one = ["vector", "check", face, "--candidate", str(broken / "five-faces")]
        runs.run("vector/minimize", [*one, "--minimize", "{out}/small", "--diff", "{out}/diff.png"], (0, 1))
        runs.run("vector/probes", ["vector", "calibrate", "--probes", "{out}/probes"])
        subprocess.run([runs.program, "-q", "vector", "calibrate", "--probes", str(runs.folder / "probes")], check=True,
                       stdout=subprocess.DEVNULL)
        probes = str(runs.folder / "probes")
        runs.render("vector/render", runs.folder / "probes")
        runs.run("vector/calibrate", ["vector", "calibrate", probes, "--candidate", probes, "-o", "{out}/profile.json"],
                 (0, 1))
    for folder in ("suite", "random", "broken", "probes"):
        shutil.rmtree(runs.folder / folder, ignore_errors=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("program", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("folder", type=pathlib.Path)
    arguments = parser.parse_args()
    shutil.rmtree(arguments.folder, ignore_errors=True)
    arguments.folder.mkdir(parents=True)
    runs = Runs(arguments.program, arguments.folder.resolve())
    for scene in sorted(DATA.glob("*.obj")):
        if not (arguments.quick and scene.stem in LARGE | {"furnished-room"}):
            write_scene(runs, scene, arguments.quick)
    write_vectors(runs, arguments.quick)
    runs.finish()
    sys.exit(1 if runs.failed else 0)


if __name__ == "__main__":
    main()
