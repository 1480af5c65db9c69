#!/usr/bin/env python3
"""Mutation test of the sign tests: every mutant in mutants.txt must fail a test.

    scripts/mutants/run.py              all of them
    scripts/mutants/run.py 3 17-20      some, by their numbers
    scripts/mutants/run.py src/cull     those of files whose path begins so
    scripts/mutants/run.py --list       their numbers
    scripts/mutants/run.py --check      whether each still has its one place; builds nothing

All mutants go into one copy of the sources (target/mutants/tree), each behind a
check of the environment variable MUTANT, so that there is one build, and a
mutant costs no more than its tests. The working tree is not touched. Ends with
an error if a mutant survives that is not marked as equivalent.

A mutant is one line of the list, under the `[file]` it is in:

    context «expression» context ~> replacement ## why it is equivalent

Without «» all of the left side is the expression. The left side must occur once
in the file; its white space stands for any white space.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TREE = ROOT / "target/mutants/tree"
COPIED = ["Cargo.toml", "Cargo.lock", "README.md", "benches", "crates", "docs", "examples", "src", "tests"]
# Quickest to fail first. The library's tests without those of tables.
TESTS = [
    ("differential", []),
    ("verify_families", []),
    ("frusta", ["clip::", "exact::", "frustum::"]),
    ("clippers", []),
    ("signs", []),
    ("guarantees", []),
    ("regressions", []),
    ("stages", []),
    ("slices", []),
]
# Volumes and batches have their own.
VOLUME_TESTS = [("volumes", []), ("frusta", ["cull::"]), ("bounds", []), ("regressions", [])]
# Slices are compared with single calls first. So are the rules that all share.
SLICE_TESTS = [("frusta", ["clip::many::"]), *TESTS]
INTERVAL_TESTS = [("frusta", ["clip::many::intervals::", "cull::"]), ("volumes", [])]
PROJECTION_TESTS = [("projection", []), ("projection_matrices", [])]
SECONDS = 300

SWITCH = """
pub(crate) fn mutant(number: u32) -> bool {
    static CHOSEN: std::sync::LazyLock<u32> = std::sync::LazyLock::new(|| {
        std::env::var("MUTANT").ok().and_then(|n| n.parse().ok()).unwrap_or(0)
    });
    *CHOSEN == number
}
"""


class Mutant:
    def __init__(self, number, file, line):
        body, _, self.equivalent = (s.strip() for s in line.partition(" ## "))
        self.left, _, self.to = (s.strip() for s in body.partition(" ~> "))
        self.number, self.file = number, file
        assert self.to, f"no replacement: {line}"

    def __str__(self):
        return f"{self.number:3} {self.file}: {self.left} ~> {self.to}"

    def span(self, text):
        """Where the expression is in the file's text."""
        before, mark, rest = self.left.partition("«")
        inside, _, after = rest.partition("»") if mark else (self.left, "", "")
        before = before if mark else ""

        def pattern(s):
            return r"\s+".join(re.escape(w) for w in s.split())

        def joined(a, b):
            return r"\s+" if a[-1:].isspace() or b[:1].isspace() else r"\s*"

        whole = ""
        if before:
            whole += pattern(before) + joined(before, inside)
        whole += f"({pattern(inside)})"
        if after:
            whole += joined(inside, after) + pattern(after)
        found = list(re.finditer(whole, text))
        assert len(found) == 1, f"{len(found)} places: {self}"
        return found[0].span(1)


def read_list():
    mutants, file = [], None
    for line in (ROOT / "scripts/mutants/mutants.txt").read_text().splitlines():
        line = line.strip()
        if line.startswith("[src/"):
            file = line[1:-1]
        elif line and not line.startswith("#"):
            mutants.append(Mutant(len(mutants) + 1, file, line))
    return mutants


def rendered(text, start, end, spans):
    """text[start:end] with its mutants, outermost first."""
    out, at = [], start
    while spans:
        a, b = spans[0][0]
        assert at <= a and b <= end, f"overlaps another: {spans[0][1][0]}"
        inner = [s for s in spans[1:] if s[0][0] < b]
        original = rendered(text, a, b, inner)
        choices = "".join(
            f"if crate::mutant({m.number}) {{ ({m.to}) }} else " for m in spans[0][1]
        )
        out += [text[at:a], f"({choices}{{ ({original}) }})"]
        at, spans = b, spans[1 + len(inner) :]
    return "".join(out) + text[at:end]


def write_tree(mutants):
    shutil.rmtree(TREE, ignore_errors=True)
    TREE.mkdir(parents=True)
    for name in COPIED:
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
        copy(ROOT / name, TREE / name)
    for file in {m.file for m in mutants}:
        text = (ROOT / file).read_text()
        places = {}
        for m in mutants:
            if m.file == file:
                places.setdefault(m.span(text), []).append(m)
        spans = sorted(places.items(), key=lambda s: (s[0][0], -s[0][1]))
        (TREE / file).write_text(rendered(text, 0, len(text), spans))
    lib = TREE / "src/lib.rs"
    lib.write_text("#![allow(warnings)]\n" + lib.read_text() + SWITCH)


def build():
    """The test binaries, by name."""
    names = {n for n, _ in TESTS + VOLUME_TESTS + PROJECTION_TESTS if n != "frusta"}
    targets = ["--lib"] + [a for n in names for a in ("--test", n)]
    command = ["cargo", "test", "--package", "frusta", "--package", "frusta-lab", "--no-run"]
    command += ["--message-format", "json-render-diagnostics", *targets]
    env = os.environ | {"CARGO_TARGET_DIR": str(ROOT / "target/mutants/build")}
    done = subprocess.run(command, cwd=TREE, env=env, stdout=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit("the mutated tree does not build")
    messages = (json.loads(line) for line in done.stdout.splitlines())
    return {
        m["target"]["name"]: m["executable"] for m in messages if m.get("executable")
    }


def killer(binaries, number, tests=TESTS):
    """The first test binary to fail, or None."""
    env = os.environ | {
        "MUTANT": str(number),
        "PROPTEST_RNG_SEED": "20261122",
        "PROPTEST_MAX_SHRINK_ITERS": "0",
        "PROPTEST_DISABLE_FAILURE_PERSISTENCE": "1",
        "RUST_BACKTRACE": "0",
    }
    for name, filters in tests:
        try:
            done = subprocess.run(
                [binaries[name], "-q", *filters],
                cwd=TREE,
                env=env,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                timeout=SECONDS,
            )
        except subprocess.TimeoutExpired:
            return name + " (too slow)"
        if done.returncode:
            return name
    return None


def tests_of(file):
    if file.startswith("src/clip/many/intervals/"):
        return INTERVAL_TESTS
    if file.startswith(("src/clip/many/", "src/clip/rules/", "src/clip/whole")):
        return SLICE_TESTS
    if file.startswith(("src/cull/", "src/frustum/eval/half_space")):
        return VOLUME_TESTS
    if file.startswith("src/frustum/project/"):
        return PROJECTION_TESTS
    return TESTS


def main():
    mutants = read_list()
    arguments = sys.argv[1:]
    if arguments == ["--list"]:
        print(*mutants, sep="\n")
        return
    if arguments == ["--check"]:
        for m in mutants:
            m.span((ROOT / m.file).read_text())
        print(f"{len(mutants)} mutants, each with its one place")
        return
    chosen = {m.number for m in mutants for a in arguments if m.file.startswith(a)}
    for a in arguments:
        if a.startswith("src/"):
            continue
        first, _, last = a.partition("-")
        chosen |= set(range(int(first), int(last or first) + 1))
    write_tree(mutants)
    binaries = build()
    if by := killer(binaries, 0) or killer(binaries, 0, VOLUME_TESTS):
        sys.exit(f"{by} fails without a mutant")
    counts = {"killed": 0, "equivalent": 0, "SURVIVED": 0}
    for m in mutants:
        if chosen and m.number not in chosen:
            continue
        began = time.monotonic()
        by = killer(binaries, m.number, tests_of(m.file))
        verdict = "killed" if by else "equivalent" if m.equivalent else "SURVIVED"
        counts[verdict] += 1
        note = f"by {by}" if by else m.equivalent
        if by and m.equivalent:
            note += ", though marked as equivalent"
        seconds = time.monotonic() - began
        print(f"{verdict:10} {m}  ({note}; {seconds:.0f} s)", flush=True)
    said = ", ".join(f"{n} {verdict}" for verdict, n in counts.items())
    print(f"{sum(counts.values())} mutants: {said}")
    sys.exit(counts["SURVIVED"] > 0)


if __name__ == "__main__":
    main()
