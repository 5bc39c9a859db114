# SPDX-License-Identifier: Apache-2.0
"""Case files with mistakes: `talus check` says yes or what is wrong, within seconds."""
from pathlib import Path

from attack import Attack, require

PROJECT = Path(__file__).resolve().parents[2]
SECONDS = 20  # of processor time
WORDS = ("=", '"', "[", "]", "[[plates]]\n", ".", ",", "\n", "\\u001b", "\x1b", "-", "1e308", "1e-308", "99999999999",
         "-1", "0", "nan", "inf", "true", " mm", "m^", "(", ")", "1e99999", "\u00b5", "{", "}", "#", "'''", '"""', "e9",
         "000000")


def change(random, text, others):
    place = random.randrange(len(text) + 1)
    end = min(len(text), place + random.randint(1, 20))
    kind = random.randrange(7)
    if kind == 0:
        return text[:place] + chr(random.randrange(256)) + text[place + 1:]
    if kind == 1:
        return text[:place] + text[end:]
    if kind == 2:
        return text[:end] + text[place:end] + text[end:]
    if kind == 3:
        return text[:place] + random.choice(WORDS) + text[place:]
    if kind == 4:
        return text[:place] + random.choice(WORDS) + text[end:]
    lines = text.split("\n")
    line = random.randrange(len(lines))
    if kind == 5:  # a line of another case
        other = random.choice(others).split("\n")
        return "\n".join([*lines[:line], random.choice(other), *lines[line:]])
    key = lines[line].split("=")[0]  # another size
    value = random.choice(("1e6 m", "1e-6 m", "0", "-1", "1e300", '"1e9 s"', '"1e-300 Pa s"', '"1 nm"', "1000000000"))
    return "\n".join([*lines[:line], f'{key}= {value}', *lines[line + 1:]])


class HostileCases(Attack):
    name, full = "hostile cases", 2000

    def prepare(self):
        self.cases = [path.read_text() for path in sorted((PROJECT / "cases").glob("*.toml"))]
        require(len(self.cases) > 5, "no cases to begin with")

    def trial(self, random, folder, most):
        text = random.choice(self.cases)
        for _ in range(random.randint(1, 4)):
            text = change(random, text, self.cases)
        (folder / "case.toml").write_bytes(text.encode(errors="replace"))
        self.talus(("check", "case.toml", "--threads", 1), folder, (0, 2), SECONDS)
        require([path.name for path in folder.iterdir()] == ["case.toml"], "check wrote a file")
        return 1
