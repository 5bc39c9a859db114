#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Checks every command of the documents, the lines of code that begin with a program of ours.

A line of `talus` must name a command that there is, options that it has, with the values that they take, no place too few
or too many, and files of the repository that exist; a case with its --set and --vary must be one that `talus check`
accepts. A line of `python3 FILE`, `tools/...` or `./...` must name a file that exists.

  tools/check_commands.py [PROGRAM]     build/talus if not given
"""

import itertools
import json
import pathlib
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from check_documents import tracked  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAMS = re.compile(r"(?:\$ )?(?:\S*/)?(talus|python3|\.?/?(?:run|test)|tools/\S+|validation/\S+\.py|build(?:-fuzz)?/\S+"
                      r"|cmake|ctest|git clone|apt-get|export|mkdir|paraview)(?= |$)")


def code_lines(path):
    """Numbered lines of code, those that end with a backslash joined with the next."""
    fenced, begun = None, None
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if line.lstrip().startswith("```"):
            fenced = None if fenced is not None else line.strip("` \t")
            continue
        if fenced not in (None, "", "sh", "bash") or (fenced is None and not line.startswith("    ")):
            begun = None
            continue
        text = line.strip()
        if begun:
            text = begun[1] + " " + text
        first = begun[0] if begun else number
        begun = None
        if text.endswith("\\"):
            begun = (first, text[:-1].rstrip())
            continue
        yield first, text


def without_comment(line):
    """What stands before two blanks, unless they are within double quotes."""
    quoted = False
    for at, character in enumerate(line):
        quoted ^= character == '"'
        if not quoted and line[at:at + 2] == "  ":
            return line[:at]
    return line


def commands_of(root, paths):
    """(where, words) of each command line; what stands behind two blanks says what the line does."""
    for path in paths:
        for number, line in code_lines(path):
            if not PROGRAMS.match(line):
                continue
            where = f"{path.relative_to(root)}:{number}"
            for part in re.split(r" && | \|\|? ", without_comment(line)):
                try:
                    words = shlex.split(part, comments=True)
                except ValueError as error:
                    yield where, None, str(error)
                    continue
                if words and words[0] == "$":
                    words = words[1:]
                if words:
                    yield where, words, part


def is_placeholder(word):
    return word.isupper() or word.startswith(("...", "~", "$", "<")) or word in ("FILE", "DIR")


def parse(usage, words):
    """What is wrong with the words behind `talus`; the command and its values by option."""
    name, given = "", []
    rest = list(words)
    while rest and usage[name]["commands"]:
        if rest[0] in ("--help", "--version"):
            return [], name, {}
        if rest[0] not in usage[name]["commands"]:
            return [f"there is no command '{' '.join(filter(None, (name, rest[0])))}'"], name, {}
        name = f"{name} {rest.pop(0)}".strip()
    options = {n: option for option in usage[name]["options"] if not option["place"] for n in option["names"]}
    places = [option for option in usage[name]["options"] if option["place"]]
    problems, values = [], {}
    while rest:
        word = rest.pop(0)
        if not word.startswith("-") or word == "-":
            given.append(word)
            continue
        key, equals, value = word.partition("=")
        if key not in options:
            problems.append(f"talus {name} has no option {key}")
            continue
        option = options[key]
        if not option["value"]:
            if equals:
                problems.append(f"{key} takes no value")
            continue
        if not equals:
            if not rest:
                problems.append(f"{key} lacks its value")
                continue
            value = rest.pop(0)
        if option["choices"] and value not in option["choices"] and not is_placeholder(value):
            problems.append(f"{key} {value}: one of {', '.join(option['choices'])}")
        values.setdefault(option["names"][0], []).append(value)
    least = sum(option["required"] for option in places)
    most = float("inf") if any(option["several"] for option in places) else len(places)
    if not least <= len(given) <= most:
        problems.append(f"talus {name} takes {least} to {most} of {', '.join(o['names'][0] for o in places)}, not {len(given)}")
    for option, word in zip(places, given):
        if option["choices"] and word not in option["choices"] and not is_placeholder(word):
            problems.append(f"{word}: one of {', '.join(option['choices'])}")
    values[""] = given
    return problems, name, values


def missing_files(root, words):
    """Files of the repository that a command names and that are not there; what a run would leave need not be."""
    for word in words:
        if re.match(r"(cases|validation|tools|python|docs)/", word) and not is_placeholder(word.rsplit("/", 1)[-1]):
            if not (root / word).exists():
                yield f"there is no {word}"


def check_words(root, usage, words):
    """What is wrong with one command line, and the cases that it runs: (file, setting...), to be checked by the program."""
    program = words[0].rsplit("/", 1)[-1]
    problems = list(missing_files(root, words[1:]))
    if program != "talus":
        if re.match(r"(\./|tools/|validation/)", words[0]) and not (root / words[0]).exists():
            problems.append(f"there is no {words[0]}")
        return problems, []
    wrong, name, values = parse(usage, words[1:])
    problems += wrong
    case = (values.get("") or [""])[0]
    if problems or name not in ("run", "check", "ensemble") or not case.startswith("cases/"):
        return problems, []
    varied = []
    for text in values.get("--vary", []):
        key, _, choices = text.partition("=")
        varied.append([f"{key}={choice}" for choice in choices.split(",")])
    settings = values.get("--set", [])
    # Each value of a varied key once, with the first of the others: their product would take long.
    first = [choices[0] for choices in varied]
    cases = [(case, *settings, *first)]
    for n, choices in enumerate(varied):
        cases += [(case, *settings, *first[:n], choice, *first[n + 1:]) for choice in choices[1:]]
    return problems, cases


def check(root, program, paths):
    usage = json.loads(subprocess.run([program, "schema", "--commands"], capture_output=True, text=True, check=True).stdout)
    cases, problems, count = {}, [], 0
    for where, words, text in commands_of(root, paths):
        if words is None:
            problems.append(f"{where}: {text}")
            continue
        count += 1
        wrong, of_line = check_words(root, usage, words)
        problems += [f"{where}: {problem}" for problem in wrong]
        for case in of_line:
            cases.setdefault(case, where)

    def check_case(case):
        options = list(itertools.chain.from_iterable(("--set", setting) for setting in case[1:]))
        return subprocess.run([program, "check", case[0], "--threads", "1", *options], cwd=root, capture_output=True,
                              text=True, check=False)
    with ThreadPoolExecutor(2) as pool:
        for (case, where), done in zip(cases.items(), pool.map(check_case, cases)):
            if done.returncode != 0:
                problems.append(f"{where}: {' '.join(case)}: {done.stderr.strip()}")
    return problems, count, len(cases)


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/talus"
    problems, count, cases = check(ROOT, str(pathlib.Path(program).resolve()), tracked(ROOT, "*.md"))
    print("\n".join(problems), end="\n" if problems else "")
    print(f"{count} commands, {cases} cases, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
