# SPDX-License-Identifier: Apache-2.0
"""A TOML file that people write, read so that every problem is named with its line."""
import re
import tomllib
from pathlib import Path

from talus.trouble import InputError, RunError, problem


class TomlReader:
    """Values of the file's tables; remembers every problem with its line."""

    def __init__(self, path, end=None):
        """\\param end text at which the values end, if not at the file's"""
        self.path, self.problems = path, []
        try:
            text = Path(path).read_text(encoding="utf-8")
            self.file = tomllib.loads(text.partition(end)[0] if end else text)
        except OSError as error:
            raise RunError(f"{path}: cannot be read: {error.strerror}") from error
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            at = re.search(r" \(at line (\d+), column \d+\)", str(error))
            raise InputError([problem(path, str(error).replace(at[0], "") if at else str(error),
                                      line=int(at[1]) if at else 0)]) from error
        self.lines = text.splitlines()
        self.headers = [n for n, line in enumerate(self.lines, 1) if re.match(r"\s*\[+[A-Za-z]", line)]

    def line_of(self, header, count=0):
        """Of the n-th table with this header; 0 if it has none."""
        found = [n for n in self.headers if self.lines[n - 1].split("#")[0].strip() == header]
        return found[count] if count < len(found) else 0

    def fault(self, line, key, what, *, within="", **more):
        """\\param line of the table, in which the line of `within` (else of the key) is looked for"""
        end = next((n for n in self.headers if n > line), len(self.lines) + 1)
        at = (n for n in range(line + 1, end) if re.match(rf'\s*"?{re.escape(within or key)}"?\s*=', self.lines[n - 1]))
        self.problems.append(problem(self.path, what, line=next(at, line) or 1, key=key, **more))

    def get(self, table, line, key, kinds=str, allowed="text", within=""):
        value = table.get(key)
        if value is None:
            self.fault(line, key, "missing", within=within, allowed=allowed)
        elif isinstance(value, kinds) and not isinstance(value, bool):
            return value
        else:
            self.fault(line, key, "is of another type", within=within, allowed=allowed)
        return kinds() if kinds is str else 0
