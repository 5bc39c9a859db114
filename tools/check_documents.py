#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the documents against the tree: the width of prose, links, paths in backticks, the version, which CMakeLists.txt
states, where others repeat it, and the functions and tests that EQUATIONS.md names: a function that it credits has a caller in src/, so that what stands there is what is computed.
Words and names that were replaced (tools/words.csv) do not come back, in documents, code and comments."""

import argparse
import csv
import pathlib
import re
import subprocess
import sys

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
CODE = re.compile(r"`([^`\s]+)`")
WIDTH = 100  # of prose; tables, code and what cannot be broken may be wider
FOLDERS = ("src/", "tests/", "cases/", "docs/", "tools/", "validation/", "benchmarks/", "web/", "python/")


def tracked(root, *patterns):
    listed = subprocess.run(["git", "-C", str(root), "ls-files", *patterns], capture_output=True, text=True, check=True)
    return [root / name for name in listed.stdout.splitlines()]


def lines_of(path):
    """Numbered lines outside of fenced code."""
    fenced = False
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        elif not fenced:
            yield number, line


def check_width(root, documents):
    for path in documents:
        for number, line in lines_of(path):
            breakable = " " in re.sub("`[^`]*`", "code", line).lstrip("-*> 0123456789.").strip()
            if len(line) > WIDTH and breakable and not line.startswith(("|", "    ", "#", "![")):
                yield f"{path.relative_to(root)}:{number}: the line has {len(line)} characters; wrap at {WIDTH}"


def check_links(root, documents):
    for path in documents:
        for number, line in lines_of(path):
            for target in LINK.findall(line):
                if re.match(r"[a-z]+:|#", target):
                    continue
                if not (path.parent / target.split("#")[0]).exists():
                    yield f"{path.relative_to(root)}:{number}: the link {target} leads nowhere"


def check_paths(root, documents):
    for path in documents:
        if path.name not in ("README.md", "ARCHITECTURE.md", "EQUATIONS.md", "CONTRIBUTING.md"):
            continue
        for number, line in lines_of(path):
            for name in CODE.findall(line):
                if name.startswith(FOLDERS) and not re.search(r"[*<>{}…]|[A-Z]{3,}|NAME", name):
                    if not list(root.glob(name.rstrip("/"))):
                        yield f"{path.relative_to(root)}:{number}: there is no {name}"


MAX_WORDS = 97_000  # of all documents together: a page that grows takes from another


def check_length(root, documents):
    words = sum(len(path.read_text(encoding="utf-8").split()) for path in documents)
    if words > MAX_WORDS:
        yield f"{root.name}: all documents together have {words} words, at most {MAX_WORDS}"


VERSION = re.compile(r"^project\(talus VERSION ([\d.]+)", re.MULTILINE)
REPEATED = {"python/talus/__init__.py": re.compile(r'^__version__ = "([^"]*)"', re.MULTILINE),
            "CITATION.cff": re.compile(r"^version: (\S+)", re.MULTILINE),
            "CHANGELOG.md": re.compile(r"^## (\S+)", re.MULTILINE)}  # the first of its sections


def check_version(root):
    build = root / "CMakeLists.txt"
    if not build.exists():
        return
    version = VERSION.search(build.read_text(encoding="utf-8"))
    if not version:
        yield "CMakeLists.txt:1: project() states no version"
        return
    for name, pattern in REPEATED.items():
        text = (root / name).read_text(encoding="utf-8")
        found = pattern.search(text)
        if not found or found[1] != version[1]:
            line = text[: found.start()].count("\n") + 1 if found else 1
            yield f"{name}:{line}: the version is {found[1] if found else 'missing'}, in CMakeLists.txt {version[1]}"


def check_words(root):
    words = root / "tools/words.csv"
    if not words.exists():
        return
    with words.open(newline="", encoding="utf-8") as file:
        replaced = {row["phrase"]: row["in its place"] for row in csv.DictReader(file)}
    pattern = re.compile(r"(?<!\w)(?:" + "|".join(map(re.escape, replaced)) + r")(?!\w)", re.IGNORECASE)
    spelled = {phrase.lower(): phrase for phrase in replaced}
    for path in tracked(root, *(f"*.{kind}" for kind in ("md", "cpp", "hpp", "py", "toml", "in"))):
        name = str(path.relative_to(root))
        if name.startswith("docs/reproduction/") or not path.exists():  # pages that a command writes
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            for found in pattern.findall(line):
                yield f"{name}:{number}: \"{found}\": {replaced[spelled[found.lower()]]}"


def without_comments(text):
    return re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.DOTALL)


def is_declared_at(source, begin):
    """Whether the name that begins there is declared or defined, not used: a type stands before it."""
    before = re.sub(r"(?:\w+\s*(?:<[^<>]*>)?::\s*)+$", "", source[max(0, begin - 200) : begin])
    word = re.search(r"(?<!\w)(\w+)\s+$", before)
    if word:
        return word.group(1) not in ("return", "else", "do", "case", "throw", "co_return", "co_yield", "and", "or", "not")
    return re.search(r"\S[*&>]+\s+$|~$", before) is not None  # "Vector& f(", but "a * f(" has a space before the star


def is_used(name, source):
    """Whether a function is called, or handed on by its name; an operator is used without being named."""
    uses = (not is_declared_at(source, found.start()) for found in re.finditer(rf"\b{name}\b(?!\s*::)", source))
    return name == "operator" or any(uses)


def check_equations(root):
    """In the tables of EQUATIONS.md, `name()` is a function of src/ that is called there and `Suite.Test` a test of tests/."""
    document = root / "EQUATIONS.md"
    if not document.exists():
        yield "EQUATIONS.md:1: is missing"
        return
    source = "\n".join(without_comments(p.read_text(encoding="utf-8")) for p in sorted((root / "src").rglob("*.?pp")))
    tests = "\n".join(p.read_text(encoding="utf-8") for p in (root / "tests").rglob("*.*p*") if p.suffix in {".cpp", ".py"})
    for number, line in lines_of(document):
        if not line.startswith("|"):
            continue
        for name in CODE.findall(line):
            function = re.fullmatch(r"(?:\w+::)*(\w+)\(\)", name)
            test = re.fullmatch(r"([A-Z]\w+)\.(\w+)", name)
            if function and not re.search(rf"\b{function.group(1)}\(", source):
                yield f"EQUATIONS.md:{number}: src/ has no function {name}"
            elif function and not is_used(function.group(1), source):
                yield f"EQUATIONS.md:{number}: nothing in src/ calls {name}"
            if test and not re.search(rf"\(\s*{test.group(1)}\s*,\s*{test.group(2)}\s*\)", tests):
                yield f"EQUATIONS.md:{number}: there is no test {name}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", nargs="?", default=pathlib.Path(__file__).resolve().parent.parent, type=pathlib.Path)
    root = parser.parse_args().root
    documents = tracked(root, "*.md")
    problems = [*check_width(root, documents), *check_links(root, documents), *check_paths(root, documents),
                *check_length(root, documents), *check_version(root),
                *check_equations(root), *check_words(root)]
    print("\n".join(problems), end="\n" if problems else "")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
