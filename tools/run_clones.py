#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Does in a clone of the repository what changes or builds it, which tools/run_commands.py leaves out; some minutes.

  tools/run_clones.py [--keep]

1. ./run where npm is not there: it builds, runs, says that there is no report.html, and ends with the results and the
   picture. npm is hidden in a name space of mounts (unshare), and apt-get fails as without a network.
2. docs/how-to/my-law.md: the law of the page is copied and entered as its steps 1 and 2 say, ./run --build-only is step 3;
   then the program knows the law by its name, its keys and the command of the page.

What is cloned is the last commit. The compiler's cache (ccache) is used where CMAKE_CXX_COMPILER_LAUNCHER says so.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
CASE = ("cases/yuu2011-section-vacuum.toml", "--set", "gate.opens=from-the-start", "--set", "run.end=2 ms")


class Fault(Exception):
    pass


def demand(condition, what):
    if not condition:
        raise Fault(what)


class Clone:
    def __init__(self, folder):
        self.folder = folder / "talus"
        subprocess.run(["git", "clone", "--quiet", ROOT, self.folder], check=True)
        self.programs = folder / "bin"
        self.programs.mkdir()
        (self.programs / "apt-get").write_text("#!/bin/sh\nexit 100\n")
        (self.programs / "apt-get").chmod(0o755)
        self.nothing = folder / "nothing"
        self.nothing.write_text("")
        self.npm = shutil.which("npm")

    def without_npm(self, *words):
        """Runs a command where npm cannot be executed; returns what it said."""
        environment = {**os.environ, "PATH": f"{self.programs}:{os.environ['PATH']}"}
        hide = f'mount --bind "{self.nothing}" "{os.path.realpath(self.npm)}" && ' if self.npm else ""
        done = subprocess.run(["unshare", "--map-root-user", "--mount", "sh", "-c",
                               hide + '! command -v npm > /dev/null && exec "$@"', "sh", *words],
                              cwd=self.folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              check=False)
        demand(done.returncode == 0, f"{' '.join(words)}: status {done.returncode}\n{done.stdout[-2000:]}")
        return done.stdout

    def run_without_npm(self):
        """./run as somebody does who has no npm."""
        said = self.without_npm("./run", *CASE)
        demand(re.search(r"[Bb]uilt without report\.html", said), f"the build says nothing of report.html:\n{said}")
        demand("No report.html" in said, f"the run says nothing of report.html:\n{said}")
        last = said.splitlines()[-2:]
        demand(len(last) == 2 and last[0].startswith("Results: ") and last[1].startswith("Picture: "), f"ends with {last}")
        results, picture = (self.folder / line.split(": ", 1)[1] for line in last)
        demand((picture.read_bytes()[:4] == b"\x89PNG") and results in picture.parents, f"{picture} is no picture")
        demand(not (results / "report.html").exists(), "there is a report.html")
        report = subprocess.run(["build/talus", "report", results], cwd=self.folder, capture_output=True, text=True, check=False)
        demand(report.returncode == 4 and "npm" in report.stderr, f"talus report: {report.returncode}\n{report.stderr}")

    def add_the_law_of_the_page(self):
        """Steps 1 to 3 of docs/how-to/my-law.md."""
        page = (self.folder / "docs/how-to/my-law.md").read_text(encoding="utf-8")
        for word in ("src/physics/granular/", "src/physics/granular/law.hpp", "`AnyLaw`", "./run --build-only"):
            demand(word in page, f"my-law.md has no {word}")
        laws = self.folder / "src/physics/granular"
        shutil.copy(self.folder / "docs/how-to/cohesive_grains.hpp", laws)
        text = (laws / "law.hpp").read_text(encoding="utf-8")
        text = text.replace('#include "physics/granular/critical_state.hpp"\n',
                            '#include "physics/granular/cohesive_grains.hpp"\n#include "physics/granular/critical_state.hpp"\n')
        text, count = re.subn(r"(using AnyLaw = std::variant<[^>]*)>", r"\1, CohesiveGrains>", text)
        demand(count == 1, "law.hpp has no list AnyLaw")
        (laws / "law.hpp").write_text(text, encoding="utf-8")
        demand("The program: build/talus" in self.without_npm("./run", "--build-only"), "./run --build-only does not say where")

        def talus(*words, status=0):
            done = subprocess.run(["build/talus", *words], cwd=self.folder, capture_output=True, text=True, check=False)
            demand(done.returncode == status, f"talus {' '.join(words)}: status {done.returncode}\n{done.stderr}")
            return done.stdout + done.stderr

        law = ("--set", "law.name=cohesive-grains")
        talus("run", *CASE, *law, "--set", "law.cohesive-grains.cohesion=50 Pa", "--set", "output.pictures=false", "--out",
              "results/cohesive")
        demand("law.cohesive-grains.cohesion" in talus("check", CASE[0], *law, "--set", "law.cohesive-grains.cohesoin=50 Pa",
                                                       status=2), "a key of the law that is misspelt has no nearest one")
        talus("law", CASE[0], *law, "--path", "cases/law/shear.csv", "--out", "results/law")
        demand("cohesive-grains" in talus("schema", "continuum", "--markdown"), "the reference page has no cohesive-grains")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--keep", action="store_true", help="leave the clone, and say where")
    given = parser.parse_args()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="talus-clone-"))
    failed = 0
    clone = Clone(folder)
    for step in (clone.run_without_npm, clone.add_the_law_of_the_page):
        try:
            step()
            print(f"ok      {step.__doc__.splitlines()[0]}", flush=True)
        except Fault as fault:
            failed += 1
            print(f"FAILED  {step.__doc__.splitlines()[0]}\n{fault}", flush=True)
    if given.keep:
        print(folder)
    else:
        shutil.rmtree(folder)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
