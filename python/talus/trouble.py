# SPDX-License-Identifier: Apache-2.0
"""What is raised when a folder or file is not what it should be, or the input of a command."""
import difflib


class RunError(Exception):
    """A run's folder or one of its files cannot be read as asked; the message names it and what is there instead."""


class InputError(RunError):
    """The input is wrong: `problems`, every one of them as a text."""

    def __init__(self, problems):
        super().__init__("\n".join(problems))
        self.problems = list(problems)


def nearest(name, known):
    """The nearest of several words, empty if none is near; large and small letters are the same, as are '-', '_', ' '."""
    folded = {word.lower().replace("-", "_").replace(" ", "_"): word for word in known}
    near = difflib.get_close_matches(name.lower().replace("-", "_").replace(" ", "_"), folded, 1)
    return folded[near[0]] if near else ""


def problem(where, what, *, line=0, key="", allowed="", near=""):
    """`reference.toml:12: quantity: there is no such; allowed: ...; did you mean '...'?`"""
    text = f"{where}:{line}: " if line else f"{where}: "
    text += f"{key}: {what}" if key else what
    text += f"; allowed: {allowed}" if allowed else ""
    return text + (f"; did you mean '{near}'?" if near else "")


def unknown(path, kind, name, known):
    """The error for a name that is not there, with the nearest one that is."""
    known = list(known)
    near = nearest(str(name), map(str, known))
    return RunError(f'{path}: there is no {kind} "{name}"' + (f'; did you mean "{near}"?' if near else ".") +
                    f" There are: {', '.join(map(str, known)) or 'none'}")
