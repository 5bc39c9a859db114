#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the commands of talus that documents show, page by page, in the order in which they stand, in a folder of its own.

  tools/run_commands.py [--program PROGRAM] [PAGE...]     build/talus and the pages for users if not given

What takes minutes is cut short: runs end after a few steps with their gate open, clouds have 40 grains, ensembles two
members, and pictures show the first snapshot. So what is checked is that each command does its work after those that
stand before it. Left out, and listed at the end: lines with placeholders (AIR, RUNS, ...), what reproduces a paper,
compares with its rows or submits to a cluster, movies without ffmpeg, and programs other than talus with what needs
their results. tools/check_commands.py checks all lines, but runs none.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from check_commands import commands_of, is_placeholder  # noqa: E402
from check_documents import tracked  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = ("README.md", "docs/*.md", "docs/tutorials/*.md", "docs/how-to/*.md", "docs/theory/*.md")
SHORT = {"cloud": {"particles.count": "40", "run.end": "200 us", "output.snapshots": "50 us"},
         "continuum": {"gate.opens": "from-the-start", "run.end": "1 ms", "output.snapshots": "0.5 ms"},
         "air": {"run.end": "1 ms", "output.snapshots": "0.5 ms"}}
LATER = {"cloud": "400 us", "continuum": "2 ms", "air": "2 ms"}  # where a command sets its own end


class Page:
    """A folder in which the commands of one page run."""

    def __init__(self, program):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="talus-page-"))
        for name in ("cases", "validation", "python"):
            (self.folder / name).symlink_to(ROOT / name)
        (self.folder / "build").mkdir()
        (self.folder / "build/talus").symlink_to(program)
        (self.folder / "results").mkdir()
        (self.folder / "mine.csv").write_text("x,y,z,radius\n0,0,0.003,0.003\n0.01,0,0.003,0.003\n0,0.01,0.003,0.003\n")
        self.program = program
        self.left_out = []

    def run(self, words):
        return subprocess.run([self.program, *words], cwd=self.folder, capture_output=True, text=True, check=False)

    def model_of(self, case):
        return tomllib.loads((self.folder / case).read_text(encoding="utf-8")).get("model")

    def cut_short(self, words):
        """The same command with less to compute."""
        words = list(words)
        if words[0] in ("run", "ensemble") and (self.folder / words[1]).is_file():
            model = self.model_of(words[1])
            given = {words[n + 1].partition("=")[0] for n, word in enumerate(words) if word == "--set"}
            for n, word in enumerate(words):
                if word == "--set" and words[n + 1].startswith("run.end="):
                    words[n + 1] = f"run.end={LATER[model]}"
            for key, value in SHORT[model].items():
                if key == "particles.count" and 'shape = "file"' in (self.folder / words[1]).read_text(encoding="utf-8"):
                    continue
                if key not in given or key != "run.end":
                    words += ["--set", f"{key}={value}"]
            if "--members" in words:
                words[words.index("--members") + 1] = "2"
        if words[0] in ("picture", "movie"):
            for option in ("--time", "--times"):
                if option in words:
                    words[words.index(option) + 1] = "0"
            words = [re.sub(r"^(--times?)=.*", r"\1=0", word) for word in words]
        return words

    def prepare(self, words):
        """Runs the case behind a folder of results that another page makes."""
        for word in words[1:]:
            match = re.fullmatch(r"results/([\w.-]+)", word)
            if match and not (self.folder / word).exists() and (self.folder / f"cases/{match[1]}.toml").exists() \
                    and words[words.index(word) - 1] != "--out":
                self.run(self.cut_short(["run", f"cases/{match[1]}.toml"]))

    def check(self, words):
        """What went wrong with `talus WORDS`; None if nothing did."""
        self.prepare(words)
        words = self.cut_short(words)
        again = words[0] in ("run", "law", "new") and "--resume" not in words and "--overwrite" not in words
        done = self.run(words + (["--overwrite"] if again else []))
        allowed = {0} | ({130} if "--walltime" in words else set()) | ({1} if words[0] == "compare" else set())
        if done.returncode in allowed:
            return None
        return f"talus {' '.join(words)}: status {done.returncode}\n{done.stderr.strip()[-800:]}"


def reason_to_leave_out(words):
    if words[0].rsplit("/", 1)[-1] != "talus":
        return "another program"
    if any(is_placeholder(word) or "..." in word for word in words[1:]) or len(words) == 1:
        return "placeholders"
    if words[1] == "reproduce":
        return "takes minutes"
    if words[1] == "compare" and any("reference.toml" in word for word in words):
        return "needs the whole run"
    if "slurm" in words:
        return "needs a cluster"
    if words[1] == "movie" and not shutil.which("ffmpeg"):
        return "needs ffmpeg"
    return None


def run_page(program, path, root=ROOT):
    """Problems, how many commands ran, and those left out with the reason."""
    page, problems, count, left_out, not_made = Page(program), [], 0, [], set()
    for where, words, text in commands_of(root, [path]):
        reason = reason_to_leave_out(words) if words else text
        if not reason and not_made & set(words):
            reason = "needs what another program makes"
        if reason:
            not_made |= {word for word in words or () if word.startswith("results/")}
            left_out.append(f"{where}: {reason}: {text.strip()}")
            continue
        problem = page.check(words[1:])
        count += 1
        if problem:
            problems.append(f"{where}: {problem}")
    shutil.rmtree(page.folder)
    return problems, count, left_out


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/talus")
    parser.add_argument("pages", nargs="*", type=pathlib.Path)
    given = parser.parse_args()
    os.environ.setdefault("TALUS", str(given.program.resolve()))
    total, failed, left_out = 0, 0, []
    for path in [page.resolve() for page in given.pages] or tracked(ROOT, *PAGES):
        problems, count, left = run_page(given.program.resolve(), path)
        total, failed, left_out = total + count, failed + len(problems), left_out + left
        print("".join(problem + "\n" for problem in problems), end="", flush=True)
    print("".join(f"not run: {line}\n" for line in left_out), end="")
    print(f"{total} commands run, {failed} failed, {len(left_out)} not run")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
