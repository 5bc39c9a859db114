#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs clang-tidy (.clang-tidy) on the files of src/, as many at once as there are processors: one by one, or by folders
where the build compiles folders as one (CMAKE_UNITY_BUILD).

A file is looked at again only when something changed that its last clean result depends on: the list of checks, its
command, or one of the files of src/ that the build found it to include.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

TIDY = "clang-tidy-14"
OUTPUT = re.compile(r" -o (\S+)")


def dependencies(build):
    """The files that each object file was made of, as the build wrote them down."""
    listing = subprocess.run(["ninja", "-C", build, "-t", "deps"], check=True, capture_output=True, text=True).stdout
    found, target = {}, None
    for line in listing.splitlines():
        if line.startswith(" "):
            found[target].append(line.strip())
        elif line:
            target = line.split(":")[0]
            found[target] = []
    return found


def fingerprint(root, build, commands, files):
    digest = hashlib.sha256((root / ".clang-tidy").read_bytes() + pathlib.Path(__file__).read_bytes())
    for command in commands:
        digest.update(command["command"].encode())
    for name in sorted(files):
        path = (build / name).resolve()
        if path.is_relative_to(root / "src"):
            digest.update(path.read_bytes())
    return digest.hexdigest()


def check(root, build, path):
    """clang-tidy's findings in one file, or an empty text."""
    done = subprocess.run(
        [TIDY, "--quiet", "-p", str(build), f"--config-file={root / '.clang-tidy'}",
         "--extra-arg=-Wno-unknown-warning-option", str(path)],
        capture_output=True, text=True)
    return done.stdout + done.stderr if done.returncode else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--build", type=pathlib.Path, default=None, help="root/build if not given")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    root = arguments.root.resolve()
    build = (arguments.build or root / "build").resolve()
    clean = build / "lint"
    clean.mkdir(exist_ok=True)
    made_of = dependencies(build)

    commands = {}  # of each file: several where it is compiled for each instruction set, which clang-tidy runs in turn
    for command in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        commands.setdefault(pathlib.Path(command["file"]), []).append(command)
    waiting, keep = [], set()
    for path, several in commands.items():
        if not path.is_relative_to(root / "src") and not path.is_relative_to(build / "src"):
            continue
        files = {file for command in several for file in made_of.get(OUTPUT.search(command["command"]).group(1), [])}
        name = fingerprint(root, build, several, files)
        keep.add(name)
        if not files or not (clean / name).exists():
            waiting.append((path, name if files else None))
    for old in clean.iterdir():
        if old.name not in keep:
            old.unlink()

    problems = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for (_, name), found in zip(waiting, pool.map(lambda file: check(root, build, file[0]), waiting)):
            if found:
                print(found)
                problems += 1
            elif name:
                (clean / name).touch()
    print(f"clang-tidy: {len(keep)} files, {len(waiting)} looked at, {problems} with findings")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
