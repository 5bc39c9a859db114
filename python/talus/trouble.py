# SPDX-License-Identifier: Apache-2.0
"""What is raised when a folder or file is not what it should be."""
import difflib


class RunError(Exception):
    """A run's folder or one of its files cannot be read as asked; the message names it and what is there instead."""


def unknown(path, kind, name, known):
    """The error for a name that is not there, with the nearest one that is."""
    known = list(known)
    near = difflib.get_close_matches(str(name), known, 1)
    return RunError(f'{path}: there is no {kind} "{name}"' + (f'; did you mean "{near[0]}"?' if near else ".") +
                    f" There are: {', '.join(known) or 'none'}")
