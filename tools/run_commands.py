#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the commands and the Python that documents show, page by page, in the order in which they stand, in a folder of
its own.

  tools/run_commands.py [--program PROGRAM] [PAGE...]     build/talus and the pages for users if not given

What takes minutes is cut short: runs end after a few steps with their gate open, clouds have 40 grains, ensembles two
members, a study has coarse cases, and pictures show the first snapshot; so do scripts and Python that start the program.
In place of Slurm's sbatch stands one that takes every job and runs none. So what is checked is that each command does its
work after those that stand before it, not what it comes to. What is not run is listed at the end, with the reason, which
stands in NOT_RUN: a command that is neither run nor there is a failure. tools/check_commands.py checks all lines, but
runs none.
"""
import argparse
import importlib.util
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
PAGES = ("README.md", "CONTRIBUTING.md", "docs/*.md", "docs/tutorials/*.md", "docs/how-to/*.md", "docs/theory/*.md",
         "docs/reproduction/*.md", "docs/design/*.md")
SHORT = {"cloud": {"particles.count": "40", "run.end": "200 us", "output.snapshots": "50 us"},
         "continuum": {"gate.opens": "from-the-start", "run.end": "1 ms", "output.snapshots": "0.5 ms"},
         "air": {"run.end": "1 ms", "output.snapshots": "0.5 ms"}}
LATER = {"cloud": "400 us", "continuum": "2 ms", "air": "2 ms"}  # where a command sets its own end
# Keys of the cases with which a study is done in seconds, and its runs by their sizes.
STUDIES = {"cases/yuu2011-hopper-vacuum.toml": {"spacing": '"5 mm"', "end": '"1 ms"'},
           "cases/niiya2020-circle.toml": {"count": "200"},
           "cases/niiya2020-rectangle.toml": {"count": "200"},
           "cases/niiya2020-triangle.toml": {"count": "200"}}
SIZES = {"validation/niiya2020/reference.toml": {'"0.34 m"': '"0.11 m"', '"3.4 m"': '"0.34 m"', '"0.6 m"': '"0.19 m"',
                                                 '"run.end" = "5 ms"': '"run.end" = "1 ms"'}}
# Results that a placeholder stands for: of the case of this name.
RESULTS = {"AIR": "results/yuu2011-section-air", "VACUUM": "results/yuu2011-section-vacuum",
           "DIR": "results/yuu2011-section-air"}
SBATCH = "#!/bin/sh\necho 1\n"

# What is not run here, and why; what runs it instead, where something does.
NOT_RUN = (
    (r"\./run( --build-only)?", "builds: tools/run_clones.py runs it in a clone"),
    (r"\./test( --sanitize)?", "takes half an hour: it is what a change needs (.ci/run)"),
    (r"git clone .*|cd .*|cmake .*|ninja .*|ctest .*|mkdir .*", "builds, or tests a build: ./run and ./test do"),
    (r"apt-get .*|tools/install_packages .*", "installs packages: ./run and ./test do"),
    (r"tools/check_lint.py", "takes minutes: ./test runs it"),
    (r"tools/check_packages( --build)?", "needs root and a network, builds: a step of a release"),
    (r"tools/build_site", "needs mkdocs: tests/tools/test_site.py runs it"),
    (r"tools/campaign/run .*|tools/campaign/run", "takes half an hour: tests/tools/test_campaign.py runs a part"),
    (r"build-fuzz/.*", "needs a build by clang: tools/campaign/run --only fuzz runs it"),
    (r"validation/dem-hopper/run.py .*", "takes ten minutes, and needs LAMMPS"),
    (r"validation/dem-hopper/as_run.py .*", "needs what LAMMPS makes: tests/python/test_dem_hopper.py runs it"),
    (r"talus run .* --launch slurm .*", "submits a job: tests/app/test_slurm.py does with an sbatch of its own"),
    (r"talus calibrate --repose .*", "pours heaps, a minute each: tests/app/test_calibrate_grains.py has short ones"),
    (r"talus calibrate --grains .*", "takes LAMMPS and minutes: tests/app/test_calibrate_grains.py has a stand-in"),
    (r"paraview .*", "opens a window"),
    (r"talus", "shows its help"),
)


class Page:
    """A folder in which the commands of one page run."""

    def __init__(self, program, folder=None):
        self.program = program
        self.folder = folder or pathlib.Path(tempfile.mkdtemp(prefix="talus-page-"))
        self.left_out = []
        if folder:
            return
        for name in ("cases", "validation"):
            (self.folder / name).symlink_to(ROOT / name)
        shutil.copytree(ROOT / "python", self.folder / "python", ignore=shutil.ignore_patterns("__pycache__"))
        (self.folder / "build").mkdir()
        (self.folder / "build/talus").symlink_to(program)
        if (program.parent / "benchmarks").is_dir():
            (self.folder / "build/benchmarks").symlink_to(program.parent / "benchmarks")
        (self.folder / "results").mkdir()
        (self.folder / "mine.csv").write_text("x,y,z,radius\n0,0,0.003,0.003\n0.01,0,0.003,0.003\n0,0.01,0.003,0.003\n")
        self.add_program("sbatch", SBATCH)
        # What scripts start in place of the program: the same, cut short.
        self.add_program("talus", f"#!{sys.executable} -B\nimport pathlib, sys\nsys.path.insert(0, {str(ROOT / 'tools')!r})\n"
                                  "from run_commands import Page\n"
                                  f"page = Page(pathlib.Path({str(program)!r}), pathlib.Path({str(self.folder)!r}))\n"
                                  "sys.exit(page.stand_in(sys.argv[1:]))\n")

    def add_program(self, name, text):
        (self.folder / "bin").mkdir(exist_ok=True)
        (self.folder / "bin" / name).write_text(text, encoding="utf-8")
        (self.folder / "bin" / name).chmod(0o755)

    def environment(self):
        return {**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ.get('PATH', '')}", "HOME": str(self.folder),
                "TALUS": str(self.folder / "bin/talus"), "PYTHONPATH": str(self.folder / "python"), "MPLBACKEND": "Agg",
                "PYTHONDONTWRITEBYTECODE": "1"}

    def run(self, words, folder=None):
        """`talus WORDS`."""
        return subprocess.run([self.program, *words], cwd=folder or self.folder, capture_output=True, text=True, check=False,
                              env=self.environment())

    def run_other(self, words):
        """Another program."""
        return subprocess.run(words, cwd=self.folder, capture_output=True, text=True, check=False, env=self.environment())

    def stand_in(self, words):
        """The program for scripts: cut short, and its output passed on."""
        return subprocess.run([self.program, *self.cut_short(words)], check=False).returncode

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

    def small_project(self):
        """A folder with the same results, whose studies are done in seconds."""
        small = self.folder / "small"
        if small.exists():
            return small
        for name in ("cases", "validation", "python"):
            shutil.copytree(ROOT / name, small / name, ignore=shutil.ignore_patterns("__pycache__"))
        (small / "results").symlink_to(self.folder / "results")
        for name, keys in STUDIES.items():
            for key, value in keys.items():
                replace(small / name, rf"(?m)^{key} = .*$", f"{key} = {value}")
        for name, sizes in SIZES.items():
            for old, new in sizes.items():
                replace(small / name, re.escape(old), new)
        return small

    def prepare(self, words):
        """Runs the case behind a folder of results that another page makes; what is compared with a paper is one of it."""
        for n, word in enumerate(words):
            match = re.fullmatch(r"results/([\w.-]+)", word)
            if not match or words[n - 1] == "--out" or (self.folder / word / "manifest.json").exists():
                continue
            case, settings = f"cases/{match[1]}.toml", []
            if words[0] == "compare" and "validation/yuu2011/reference.toml" in words and not (self.folder / case).exists():
                case, settings = "cases/yuu2011-hopper-vacuum.toml", ["--set", "bed.spacing=5 mm"]
            if (self.folder / case).exists():
                self.run(self.cut_short(["run", case, "--out", word, "--set", "output.report=false", *settings]))

    def check(self, words):
        """What went wrong with `talus WORDS`; None if nothing did."""
        words = [RESULTS.get(word, word) for word in words]
        self.prepare(words)
        words = self.cut_short(words)
        again = words[0] in ("run", "law", "shear-cell", "new") and "--resume" not in words and "--overwrite" not in words
        done = self.run(words + (["--overwrite"] if again else []), self.small_project() if words[0] == "reproduce" else None)
        allowed = {0} | ({130} if "--walltime" in words else set()) | ({1} if words[0] in ("compare", "reproduce") else set())
        if done.returncode in allowed:
            return None
        return f"talus {' '.join(words)}: status {done.returncode}\n{done.stderr.strip()[-800:]}"

    def check_other(self, words):
        """What went wrong with another program."""
        words = [str(self.folder) + word[1:] if word.startswith("~/") else word for word in words]
        if words[0] == "export":
            return None  # as environment() has it
        if words[0] == "python3":
            words[0] = sys.executable
        if words[0].startswith("build/benchmarks/") and not any(word.startswith("--benchmark_min_time") for word in words):
            words.append("--benchmark_min_time=0.01")
        if "pip" in words[0]:  # without a network
            words[2:2] = ["--quiet", "--no-index", "--no-build-isolation", "--no-deps"]
        done = self.run_other(words)
        if done.returncode == 0:
            return None
        return f"{' '.join(words)}: status {done.returncode}\n{(done.stdout + done.stderr).strip()[-800:]}"

    def check_python(self, code):
        """What went wrong with the Python of the page."""
        for name in re.findall(r'Run\("(results/[\w.-]+)"\)', code):
            self.prepare(["report", name])
        done = self.run_other([sys.executable, "-c", code])
        return None if done.returncode == 0 else f"Python: {done.stderr.strip()[-800:]}"


def replace(path, pattern, text):
    old = path.read_text(encoding="utf-8")
    new = re.sub(pattern, lambda match: text, old)
    if new == old:
        raise SystemExit(f"{path} has no {pattern}")
    path.write_text(new, encoding="utf-8")


def python_of(path):
    """The Python that a page shows, all of it together, and the line on which it ends."""
    code, inside, last = [], False, 0
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if line.startswith("```"):
            inside, last = line == "```python", number if inside else last
        elif inside:
            code.append(line)
    return code, last


def without_missing_libraries(code):
    """The lines that can be run here, and those that cannot, with the reason."""
    left_out = []
    if any("paraview.simple" in line for line in code) and not importlib.util.find_spec("paraview"):
        return [], ["needs ParaView's own Python"]
    for name, method in (("pandas", "to_pandas"), ("xarray", "to_xarray")):
        if not importlib.util.find_spec(name):
            left_out += [f"needs {name}: {line.strip()}" for line in code if method in line]
            code = [line for line in code if method not in line]
    return code, left_out


def reason_to_leave_out(words):
    text = " ".join(words)
    name = words[0].rsplit("/", 1)[-1]
    for pattern, reason in NOT_RUN:
        if re.fullmatch(pattern, text if name != "talus" else " ".join([name, *words[1:]])):
            return reason
    if name != "talus":
        if words[0].startswith("build/benchmarks/"):
            return None
        return None if re.match(r"(python3|export|~/)", words[0]) else "unknown"
    if any((is_placeholder(word) and word not in RESULTS) or "..." in word for word in words[1:]):
        return "placeholders"
    if words[1] == "movie" and not shutil.which("ffmpeg"):
        return "needs ffmpeg"
    return None


def run_page(program, path, root=ROOT):
    """Problems, how many commands ran, and those left out with the reason."""
    page, problems, count, left_out, not_made = Page(program), [], 0, [], set()
    code, end_of_code = python_of(path)
    code, missing = without_missing_libraries(code)

    def run_python():
        nonlocal code, count
        if code:
            problem = page.check_python("\n".join(code))
            code, count = [], count + 1
            if problem:
                problems.append(f"{path.relative_to(root)}: {problem}")

    for where, words, text in commands_of(root, [path]):
        if int(where.rsplit(":", 1)[1]) > end_of_code:
            run_python()
        reason = reason_to_leave_out(words) if words else text
        if not reason and not_made & set(words):
            reason = "needs what another program makes"
        if not reason and words[0].startswith("build/benchmarks/") and not (page.folder / words[0]).exists():
            reason = "the benchmarks are not built"
        if reason == "unknown":
            problems.append(f"{where}: {text.strip()}: neither run nor listed in NOT_RUN")
            continue
        if reason:
            not_made |= {word for word in words or () if word.startswith("results/")}
            left_out.append(f"{where}: {reason}: {text.strip()}")
            continue
        problem = page.check(words[1:]) if words[0].rsplit("/", 1)[-1] == "talus" else page.check_other(words)
        count += 1
        if problem:
            problems.append(f"{where}: {problem}")
    run_python()
    left_out += [f"{path.relative_to(root)}: {reason}" for reason in missing]
    shutil.rmtree(page.folder)
    return problems, count, left_out


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/talus")
    parser.add_argument("pages", nargs="*", type=pathlib.Path)
    given = parser.parse_args()
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
