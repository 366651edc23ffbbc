#!/usr/bin/env python3
"""Changes the sources of `raster` and `radiosity/solver` one place at a time, and counts what their tests find.

    tests/mutation/mutate.py BUILD [--sample 500] [--seed 1] [--files REGEX] [--list]

A mutant is a copy of the sources with one comparison, arithmetic or logical operator exchanged, one constant greater or
smaller by 1, one statement removed, or one condition negated. The sample is drawn with the seed from all places. A
mutant is killed if its test program fails or runs longer than 5 times the normal time. It does not count if it does not
compile, if the compiler makes the same program of it, or if equivalent.txt says why it does the same.

BUILD holds a copy of the sources and results-SEED.csv, one line per mutant. A second run with the same seed goes on
where the first one ended. Exit code: 1 if fewer than 90 % of the mutants that count are killed.
"""
import argparse
import csv
import hashlib
import os
import random
import re
import resource
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path
from typing import NamedTuple

root = Path(__file__).resolve().parents[2]
programs = {"raster/": ["hemitex_raster_tests", "hemitex_suite_hashes"], "radiosity/solver/": ["hemitex_solver_tests"]}

exchanged = {
    "comparison": {"<": ["<=", ">="], "<=": ["<", ">"], ">": [">=", "<="], ">=": [">", "<"], "==": ["!="],
                   "!=": ["=="]},
    "arithmetic": {"+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "%": ["*"], "+=": ["-="], "-=": ["+="],
                   "*=": ["/="], "/=": ["*="], "<<": [">>"], ">>": ["<<"], "&": ["|"], "|": ["&"], "^": ["&"],
                   "&=": ["|="], "|=": ["&="]},
    "logical": {"&&": ["||"], "||": ["&&"]},
}
# Binary operators stand between blanks in this code; `<` of templates, `*` of pointers and `&` of references do not.
operator = re.compile(r"(?<= )(<<|>>|<=|>=|==|!=|&&|\|\||[-+*/&|]=|[-+*/%<>&|^])(?= )")
number = re.compile(r"(?<![\w.])(\d+\.\d*(?:e[-+]?\d+)?|\d+)([fu]?)(?![\w.'])")
statement = re.compile(r"""^\s*(?:if\s\(.*\)\s|else\s)?                                 # perhaps with its condition
    ((?:\+\+|--)?(?!return\b|if\b|for\b|while\b|case\b|using\b|static_assert\b|else\b)
     [A-Za-z_][\w:]*(?:(?:\.|->)\w+|\[[^\]]*\]|\([^;]*\))*
     (?:\s(?:=|[-+*/&|^]=)\s[^;]*)?;|(?:break|continue);|throw\s[^;]*;)\s*$""", re.VERBOSE)
condition = re.compile(r"\b(?:if|while) \(")


class Mutant(NamedTuple):
    file: str
    line: int  # from 1
    kind: str
    before: str  # the line
    after: str


def without_texts(source):
    """The source with blanks in place of comments, strings and lines of the preprocessor: positions stay."""
    texts = re.compile(r'//[^\n]*|/\*.*?\*/|'
                       r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\])+\'|^#[^\n]*', re.DOTALL | re.MULTILINE)
    return texts.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), source)


def closing(text, opened):
    """The place of the parenthesis that closes the one at `opened`, or None if the line ends before."""
    depth = 0
    for place in range(opened, len(text)):
        depth += {"(": 1, ")": -1}.get(text[place], 0)
        if depth == 0:
            return place
    return None


def changes(code, line):
    """Yields (kind, new line) for each change of a line; `code` is the line without texts."""
    for found in operator.finditer(code):
        for kind, exchanges in exchanged.items():
            for other in exchanges.get(found.group(), []):
                yield kind, line[:found.start()] + other + line[found.end():]
    for found in number.finditer(code):
        for sign in "+-":
            yield "constant", f"{line[:found.start()]}({found.group()} {sign} 1{found.group(2)}){line[found.end():]}"
    found = statement.match(code)
    if found:
        yield "statement", line[:found.start(1)] + ";"
    for found in condition.finditer(code):
        end = closing(code, found.end() - 1)
        inside = code[found.end():end]
        if end and ";" not in inside and not re.match(r"(const )?auto\b|const ", inside):
            yield "condition", line[:found.end()] + "!(" + line[found.end():end] + ")" + line[end:]


def mutants_of(file):
    source = (root / file).read_text()
    codes = without_texts(source).split("\n")
    for index, line in enumerate(source.split("\n")):
        if "static_assert" in codes[index] or codes[index].startswith("template"):
            continue
        for kind, after in changes(codes[index], line):
            yield Mutant(file, index + 1, kind, line.strip(), after.strip())


def tracked_files(*folders):
    return subprocess.run(["git", "ls-files", *folders], cwd=root, check=True, capture_output=True,
                          text=True).stdout.split("\n")[:-1]


def all_mutants(pattern):
    files = [file for file in tracked_files(*programs) if re.search(r"\.(cpp|h)$", file) and re.search(pattern, file)]
    return [mutant for file in files for mutant in mutants_of(file)]


def programs_of(file):
    return next(names for folder, names in programs.items() if file.startswith(folder))


def limit_memory():
    """A mutant may allocate without end."""
    resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))


class Build:
    """A copy of the sources and its programs."""

    def __init__(self, folder, needed):
        # As in the repository, so that ccache finds the objects of its build.
        self.source, self.build = folder / "copy", folder / "copy/build/release"
        for file in tracked_files():
            copy = self.source / file
            copy.parent.mkdir(parents=True, exist_ok=True)
            if not copy.exists() or copy.read_bytes() != (root / file).read_bytes():
                copy.write_bytes((root / file).read_bytes())
                copy.chmod((root / file).stat().st_mode)
        subprocess.run(["cmake", "--preset", "release",
                        f"-DCMAKE_CXX_COMPILER_LAUNCHER={root}/tests/mutation/compile.sh"],
                       cwd=self.source, check=True, stdout=subprocess.DEVNULL)
        if not self.make(needed, {}):
            sys.exit("mutate.py: the sources do not compile; build them first")
        self.hashes = {name: self.hash_of(name) for name in needed}
        self.normal = {}
        self.answers = {}
        for name in needed:
            start = time.monotonic()
            self.answers[name] = self.answer(name, 600)
            self.normal[name] = time.monotonic() - start
            if self.answers[name] is None:
                sys.exit(f"mutate.py: {name} fails without a mutant")

    def make(self, names, variables):
        command = ["cmake", "--build", self.build, "--parallel", str(os.cpu_count()), "--target", *names]
        return subprocess.run(command, capture_output=True, env={**os.environ, **variables}).returncode == 0

    def hash_of(self, name):
        return hashlib.sha256((self.build / "bin" / name).read_bytes()).hexdigest()

    def output(self, name, arguments, seconds):
        """What a program prints. None if it fails or takes longer."""
        process = subprocess.Popen([self.build / "bin" / name, *arguments], stdout=subprocess.PIPE,
                                   stderr=subprocess.DEVNULL, start_new_session=True, preexec_fn=limit_memory)
        try:
            output, _ = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return None
        return output if process.returncode == 0 else None

    def answer(self, name, seconds, first=""):
        """What a program prints; of tests, whether all pass, those of the file `first` first."""
        if not name.endswith("tests"):
            return self.output(name, ["2"], seconds)  # threads
        for tests in [["--filenames-as-tags", f"[#{first}_test]"], []]:
            if self.output(name, ["--abort", *tests], seconds) is None:
                return None
        return b"passed"

    def verdict(self, mutant):
        names = programs_of(mutant.file)
        file = self.source / mutant.file
        original = file.read_text()
        lines = original.split("\n")
        lines[mutant.line - 1] = mutant.after
        file.write_text("\n".join(lines))
        try:
            if not self.make(names, {"HEMITEX_MUTANT": "yes"}):
                return "does not compile"
            if all(self.hash_of(name) == self.hashes[name] for name in names):
                return "same program"
            for name in names:
                if self.answer(name, 5 * self.normal[name] + 1, Path(mutant.file).stem) != self.answers[name]:
                    return "killed"
            return "survived"
        finally:
            file.write_text(original)


def equivalents():
    """The changes that equivalent.txt explains: (file, line before, line after)."""
    known = set()
    for block in (Path(__file__).parent / "equivalent.txt").read_text().split("\n\n"):
        lines = [line for line in block.split("\n") if line and not line.startswith("#")]
        if lines:
            known.add((lines[0], lines[1].strip("- "), lines[2].strip("+ ")))
    return known


def read_results(file):
    if not file.exists():
        return {}
    with file.open(newline="") as stream:
        return {Mutant(row[1], int(row[2]), *row[3:]): row[0] for row in csv.reader(stream)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path)
    parser.add_argument("--sample", type=int, default=500, help="mutants that compile")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--files", default="", help="regular expression of the files")
    parser.add_argument("--list", action="store_true", help="print the sample and end")
    arguments = parser.parse_args()

    mutants = all_mutants(arguments.files)
    random.Random(arguments.seed).shuffle(mutants)
    if arguments.list:
        for mutant in mutants[:arguments.sample]:
            print(f"{mutant.file}:{mutant.line}: {mutant.kind}\n  - {mutant.before}\n  + {mutant.after}")
        return 0

    arguments.build.mkdir(parents=True, exist_ok=True)
    results_file = arguments.build / f"results-{arguments.seed}.csv"
    verdicts = read_results(results_file)
    build = Build(arguments.build.resolve(), sorted({name for mutant in mutants for name in programs_of(mutant.file)}))
    known = equivalents()
    counts = Counter()
    with results_file.open("a", newline="") as stream:
        for mutant in mutants:
            if sum(counts.values()) - counts["does not compile"] == arguments.sample:
                break
            if mutant not in verdicts:
                verdicts[mutant] = build.verdict(mutant)
                csv.writer(stream).writerow([verdicts[mutant], *mutant])
                stream.flush()
            verdict = verdicts[mutant]
            if verdict == "survived" and (mutant.file, mutant.before, mutant.after) in known:
                verdict = "equivalent"
            counts[verdict] += 1
            if verdict == "survived":
                print(f"{mutant.file}:{mutant.line}: survived\n  - {mutant.before}\n  + {mutant.after}", flush=True)
    counting = counts["killed"] + counts["survived"]
    print(f"{len(mutants)} places; " + ", ".join(f"{count} {verdict}" for verdict, count in sorted(counts.items())))
    print(f"killed: {counts['killed']} of {counting} that count, {100 * counts['killed'] / max(counting, 1):.1f} %")
    return 0 if counts["killed"] >= 0.9 * counting else 1


if __name__ == "__main__":
    sys.exit(main())
