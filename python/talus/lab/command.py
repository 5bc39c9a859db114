# SPDX-License-Identifier: Apache-2.0
"""What the commands share: their arguments, exit statuses, and text for a terminal."""
import argparse
import importlib.util
import os
import re
import signal
import sys

from talus.ask import ProgramFault
from talus.trouble import InputError, RunError

DONE, NOT_MET, BAD_INPUT, NUMERICAL, FILES, INTERRUPTED = 0, 1, 2, 3, 4, 130
_UNSAFE = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f\u200e\u200f\u202a-\u202e\u2066-\u2069\udc80-\udcff]")


def processors():
    return len(os.sched_getaffinity(0))


def say(text, to=None):
    """Prints a line; control characters but for line ends, and bytes that are no UTF-8, are escaped."""
    print(_UNSAFE.sub(lambda c: ascii(c[0])[1:-1].replace("\\udc", "\\x"), text), file=to or sys.stdout, flush=True)


def number(value):
    """The shortest text that reads back the same: "51", "0.1"."""
    return repr(float(value)).removesuffix(".0")


def can_draw():
    if importlib.util.find_spec("matplotlib"):
        return True
    say("No pictures of curves: they take python3 with matplotlib (Debian: python3-matplotlib).")
    return False


class Interruption:
    """Whether a signal to leave has come, SIGINT or SIGTERM; the second one ends the process."""

    def __init__(self):
        self.come = False
        for one in (signal.SIGINT, signal.SIGTERM):
            signal.signal(one, self._note)

    def _note(self, which, _):
        self.come = True
        signal.signal(which, signal.SIG_DFL)

    def __bool__(self):
        return self.come


def arguments(*places, texts=(), lists=(), numbers=(), flags=()):
    """The options of a command, which the program has checked: NAME=VALUE each, the places behind "--". What was not given
    is None, of lists empty."""
    parser = argparse.ArgumentParser(allow_abbrev=False)
    for place in places:
        parser.add_argument(place)
    for names, how in ((texts, {}), (lists, {"action": "append", "default": []}), (numbers, {"type": int}),
                       (flags, {"action": "store_true"})):
        for name in names:
            parser.add_argument(f"--{name}", **how)
    words = sys.argv[1:]
    return parser.parse_args(words if places else [word for word in words if word != "--"])


def run_command(command):
    """Turns errors into messages and exit statuses."""
    try:
        status = command()
    except InputError as error:
        for text in error.problems:
            say(text, sys.stderr)
        count = len(error.problems)
        say(f"talus: {count} problem{'s' * (count != 1)} in the input", sys.stderr)
        status = BAD_INPUT
    except ProgramFault as error:
        say(f"talus: {error}", sys.stderr)
        status = error.status
    except (RunError, OSError) as error:
        say(f"talus: {error}", sys.stderr)
        status = FILES
    except KeyboardInterrupt:
        status = INTERRUPTED
    sys.exit(status)
