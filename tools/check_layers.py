#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that src/ keeps to its layers: who may include whom, files of one instruction set, names of files that are
compiled together, lengths of files.

base < ranks < numerics < physics < models; io and analysis stand on numerics; run on io and analysis; only app sees all.
numerics, models, run and app know processes by ranks, and MPI is included in its folder petsc/ alone.
"""

import argparse
import pathlib
import re
import sys

ALLOWED = {
    "base": {"base"},
    "ranks": {"base", "ranks"},
    "numerics": {"base", "ranks", "numerics"},
    "physics": {"base", "numerics", "physics"},
    "models": {"base", "ranks", "numerics", "physics", "models"},
    "analysis": {"base", "numerics", "analysis"},
    "io": {"base", "numerics", "io"},
    "run": {"base", "ranks", "numerics", "io", "analysis", "run"},
    "app": {"base", "ranks", "numerics", "physics", "models", "analysis", "io", "run", "app"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s+([<"])([^>"]+)[>"]')
# What a file of one instruction set may include of the system: headers without templates that leak to other files.
PLAIN_SYSTEM_HEADERS = {"cmath", "cstddef", "cstdint", "type_traits", "immintrin.h", "concepts", "numbers"}
MESSAGES = re.compile(r"(mpi|petsc\w*|zoltan\w*)\.h$")
TEXTS = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)
DEFINITIONS = (  # at the beginning of a line
    re.compile(r"^(?!return |using )(?:[\w:<>,&*.]+[ &*]+)+(\w+)\(", re.M),
    re.compile(r"^(?:inline |static )*(?:constexpr|const) [\w:<>,*& ]+?\b(\w+)(?= =|\{|\[|;)", re.M),
    re.compile(r"^(?:struct|class|enum class|using(?= \w+ =)) (\w+)", re.M),
)
ALONE = re.compile(r"_for_set\.cpp$|_measures\.cpp$|/petsc/")  # compiled by themselves
GENERATED = {"revision.hpp", "material_files.inc"}  # made by the build
MOST_LINES = 400
REASON = "longer than 400 lines because"


def includes(path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        found = INCLUDE.match(line)
        if found:
            yield number, found.group(1) == "<", found.group(2)


def check_layers(root):
    problems = []
    for path in sorted((root / "src").rglob("*.?pp")):
        layer = path.relative_to(root / "src").parts[0]
        for number, system, name in includes(path):
            if system or name in GENERATED:
                continue
            target = name.split("/")[0]
            where = f"{path.relative_to(root)}:{number}"
            if not (root / "src" / name).exists():
                problems.append(f'{where}: "{name}" is not below src/; write includes from src/ on')
            elif target not in ALLOWED.get(layer, set()):
                problems.append(f"{where}: {layer} must not include {target}; see ARCHITECTURE.md, layers")
    return problems


def check_messages(root):
    """Only src/ranks/petsc knows the libraries of messages between processes."""
    problems = []
    for path in sorted((root / "src").rglob("*.?pp")):
        if path.is_relative_to(root / "src" / "ranks" / "petsc"):
            continue
        for number, system, name in includes(path):
            if system and MESSAGES.match(name):
                problems.append(f"{path.relative_to(root)}:{number}: <{name}> belongs into src/ranks/petsc alone")
    return problems


def check_run_names_no_model(root):
    problems = []
    models = [p.name for p in (root / "src" / "models").iterdir() if p.is_dir()]
    for path in sorted((root / "src" / "run").rglob("*.?pp")):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            for model in models:
                if re.search(rf"\b{model}::", line):
                    problems.append(f"{path.relative_to(root)}:{number}: run knows no model, but names {model}")
    return problems


def check_instruction_set_files(root):
    """Transitively, a *_for_set.cpp sees only plain headers."""
    problems = []
    for path in sorted((root / "src").rglob("*_for_set.cpp")):
        seen, todo = set(), [path]
        while todo:
            current = todo.pop()
            for number, system, name in includes(current):
                if system and name not in PLAIN_SYSTEM_HEADERS:
                    problems.append(
                        f"{current.relative_to(root)}:{number}: <{name}> reaches {path.name}, which is compiled for each "
                        "instruction set: its templates would leak to the other files"
                    )
                header = root / "src" / name
                if not system and header.exists() and header not in seen:
                    seen.add(header)
                    todo.append(header)
    return problems


def without_texts(path):
    return TEXTS.sub("", path.read_text(encoding="utf-8"))


def unnamed_names(text):
    """The functions, constants and types that a file keeps in unnamed namespaces."""
    names = set()
    for begin in re.finditer(r"^namespace \{$", text, re.M):
        depth, end = 1, begin.end()
        while depth and end < len(text):
            depth += {"{": 1, "}": -1}.get(text[end], 0)
            end += 1
        for pattern in DEFINITIONS:
            names.update(pattern.findall(text, begin.end(), end))
    return names


def check_unnamed_names(root):
    """Where the files of a folder are compiled as one (CMAKE_UNITY_BUILD), a name of an unnamed namespace hides a
    function of that name that a later file includes. Found by text: a name that the later file declares anywhere is
    taken for its own."""
    problems, folders = [], {}
    for path in sorted((root / "src").rglob("*.cpp")):
        if not ALONE.search(path.as_posix()):
            folders.setdefault(path.parent, {})[path] = without_texts(path)
    for files in folders.values():
        paths = list(files)
        for n, path in enumerate(paths):
            for name in sorted(unnamed_names(files[path])):
                used = re.compile(rf"(?<![\w.:>~]){name}\b(?!\s*=[^=])")
                declared = re.compile(rf"[\w>\]][&*]* (?<!return )(?<!else )(?<!throw ){name}\b\s*(?:[=({{,;:)\[]|$)|"
                                      rf"\[[^\]]*\b{name}\b[^\]]*\]|(?:, |\b(?:using|struct|class|enum) ){name}\b(?! *[(,)])")
                problems += [f"{path.relative_to(root)}:1: {name}, in its unnamed namespace, hides the one that "
                             f"{later.name} uses; give it another name" for later in paths[n + 1:]
                             if used.search(files[later]) and not declared.search(files[later])]
    return problems


def check_cycles(root):
    graph = {}
    for path in (root / "src").rglob("*.hpp"):
        graph[path] = [root / "src" / name for _, system, name in includes(path) if not system]
    problems, done = [], set()

    def visit(path, way):
        if path in way:
            names = " -> ".join(str(p.relative_to(root / "src")) for p in way[way.index(path):] + [path])
            problems.append(f"{path.relative_to(root)}:1: includes itself: {names}")
            return
        if path in done:
            return
        for target in graph.get(path, []):
            visit(target, way + [path])
        done.add(path)

    for path in sorted(graph):
        visit(path, [])
    return problems


def check_app_folders(root):
    """The folders of src/app, with the commands beside them as one more, include each other in no circle."""
    app, graph = root / "src" / "app", {}

    def folder(path):
        parts = path.relative_to(app).parts
        return parts[0] if len(parts) > 1 else "(the commands)"

    for path in sorted(app.rglob("*.?pp")) if app.is_dir() else []:
        for number, system, name in includes(path):
            target = root / "src" / name
            if system or not name.startswith("app/") or not target.exists() or folder(target) == folder(path):
                continue
            where = f"{path.relative_to(root)}:{number}: includes {name}"
            graph.setdefault(folder(path), {}).setdefault(folder(target), where)

    def way(start, goal, seen):
        """The includes that lead from a folder to another; nothing if there is no way."""
        for target, where in graph.get(start, {}).items():
            if target == goal:
                return [where]
            if target not in seen:
                rest = way(target, goal, seen | {target})
                if rest:
                    return [where] + rest
        return []

    problems = []
    for start in graph:
        circle = way(start, start, {start})
        if circle:
            problems.append(circle[0] + ", which leads back to its own folder: " + "; ".join(circle[1:]))
    return problems


def check_lengths(root):
    problems = []
    for folder in ("src", "tests", "benchmarks", "tools"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in (".cpp", ".hpp", ".py"):
                continue
            lines = path.read_text(encoding="utf-8").splitlines()
            if len(lines) > MOST_LINES and not any(REASON in line for line in lines[:12]):
                problems.append(
                    f"{path.relative_to(root)}:1: {len(lines)} lines; split it, or say at the top '{REASON} ...'"
                )
    return problems


CHECKS = (
    check_layers,
    check_messages,
    check_run_names_no_model,
    check_instruction_set_files,
    check_unnamed_names,
    check_cycles,
    check_app_folders,
    check_lengths,
)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", nargs="?", default=pathlib.Path(__file__).resolve().parent.parent, type=pathlib.Path)
    root = parser.parse_args().root
    problems = [problem for check in CHECKS for problem in check(root)]
    print("\n".join(dict.fromkeys(problems)), end="\n" if problems else "")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
