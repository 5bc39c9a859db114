# SPDX-License-Identifier: Apache-2.0
"""What is the user's stays: Talus removes and replaces what it wrote, and writes through no link out of its folder."""
import json
import os
import shutil
import unittest

from program import CASE, PROJECT, ProgramTest, tree

SHORT = ("--set", "run.end=0.1 ms", "--set", "output.pictures=true")
MINE = ("pictures/holiday.png", "analysis/mine.csv", "snapshots/old.vtkhdf", "snapshots/particles_0099.vtkhdf",
        "notes.txt")


class Folders(ProgramTest):
    def put(self, folder, names=MINE):
        for name in names:
            path = self.folder / folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text("mine")

    def assert_mine(self, folder, names=MINE):
        for name in names:
            self.assertEqual((self.folder / folder / name).read_text(), "mine", name)

    def test_overwriting_a_folder_that_never_held_a_run(self):
        self.put("r")
        before = tree(self.folder / "r")
        said = self.talus("run", "case.toml", "--out", "r", "--overwrite", *SHORT, status=2).stderr
        self.assertIn("r: is not a Talus run folder (manifest.json missing); nothing is overwritten", said)
        self.assertEqual(tree(self.folder / "r"), before)

    def test_overwriting_a_run_keeps_what_the_user_put_beside_it(self):
        self.talus("run", "case.toml", "--out", "r", *SHORT)
        names = set(tree(self.folder / "r"))
        self.put("r")
        self.talus("run", "case.toml", "--out", "r", "--overwrite", *SHORT, "--set", "output.snapshots=0.05 ms")
        self.assert_mine("r")
        self.assertEqual(len(list((self.folder / "r/snapshots").glob("particles_000?.vtkhdf"))), 3)
        self.talus("run", "case.toml", "--out", "r", "--overwrite", *SHORT)
        self.assertEqual(set(tree(self.folder / "r")), names | set(MINE))
        # The list names what is there, and nothing else.
        listed = {line[9:] for line in (self.folder / "r/files.txt").read_text().splitlines()[1:]}
        self.assertEqual(listed, names - {"files.txt"})

    def test_a_users_picture_of_the_same_name_is_not_replaced(self):
        self.talus("run", "case.toml", "--out", "r", "--set", "run.end=0.1 ms")
        self.put("r", ["pictures/frames.png"])
        said = self.talus("run", "case.toml", "--out", "r", "--resume", *SHORT, status=4).stderr
        self.assertIn("r/pictures/frames.png: is there, and r/files.txt does not say that Talus wrote it", said)
        said = self.talus("analyze", "r", status=4).stderr
        self.assertIn("r/pictures/frames.png: is there", said)
        self.assert_mine("r", ["pictures/frames.png"])

    def link(self, name):
        """Makes this part of the run `r` a link to what lies outside."""
        path, outside = self.folder / "r" / name, self.folder / "outside" / name
        outside.parent.mkdir(exist_ok=True, parents=True)
        shutil.rmtree(self.folder / "outside")
        outside.parent.mkdir(exist_ok=True, parents=True)
        if path.is_dir():
            shutil.move(path, outside)
        else:
            outside.write_text("precious")
            path.unlink(missing_ok=True)
        os.symlink(outside, path)

    def test_no_link_is_followed(self):
        for name in ("snapshots", "analysis", "pictures", "series.csv", "log.txt", "summary.json", "summary.json.part",
                     "checkpoint_a.h5", "checkpoint_b.h5.part", "manifest.json"):
            with self.subTest(name):
                self.talus("run", "case.toml", "--out", "r", *SHORT)
                self.link(name)
                outside = tree(self.folder / "outside")
                for how in ("--resume", "--overwrite"):
                    said = self.talus("run", "case.toml", "--out", "r", how, "--set", "run.end=0.2 ms",
                                      status=2).stderr
                    self.assertIn(f"r/{name}: is a symbolic link", said)
                if name in ("analysis", "pictures"):
                    said = self.talus("analyze", "r", status=4).stderr
                    self.assertIn("is a symbolic link, through which nothing is written", said)
                self.assertEqual(tree(self.folder / "outside"), outside)
                shutil.rmtree(self.folder / "r")

    def test_ensembles(self):
        command = ("ensemble", "case.toml", "--members", 2, "--jobs", 1, "--set", "run.end=0.02 ms", "--set",
                   "output.pictures=true")
        self.put("docs", ["all/members.csv", "thesis.tex"])
        for how in ((), ("--resume",)):
            said = self.talus(*command, "--out", "docs", *how, status=2).stderr
            self.assertIn("docs: is not empty, and has no files.txt", said)
        self.assert_mine("docs", ["all/members.csv", "thesis.tex"])
        self.assertEqual(len(tree(self.folder / "docs")), 2)

        self.talus(*command, "--out", "e")
        self.put("e", ["all/pictures/mine.png", "all/notes.txt"])
        shutil.move(self.folder / "e/all/pictures", self.folder / "outside")
        os.symlink(self.folder / "outside", self.folder / "e/all/pictures")
        before = tree(self.folder / "outside")
        said = self.talus(*command, "--out", "e", "--resume", status=4).stderr
        self.assertIn("is a symbolic link", said)
        self.assertEqual(tree(self.folder / "outside"), before)
        (self.folder / "e/all/pictures").unlink()
        self.talus(*command, "--out", "e", "--resume")
        self.assert_mine("e", ["all/notes.txt"])

    def test_an_empty_out_is_an_error(self):
        law = PROJECT / "validation/yuu2011/laws/simple-shear.csv"
        for command in (["run", "case.toml"], ["ensemble", "case.toml"], ["reproduce", "niiya2020"],
                        ["law", "case.toml", "--path", law]):
            for how in ([], ["--overwrite"] if command[0] == "run" else []):
                said = self.talus(*command, "--out", "", *how, status=2).stderr
                self.assertIn("--out: is empty; allowed: a folder", said)
        self.assertEqual(tree(self.folder), {"case.toml": CASE.encode()})

    def test_damaged_files_of_a_run_are_told_and_nothing_is_lost(self):
        self.talus("run", "case.toml", "--out", "whole", *SHORT)
        self.put("whole", ["notes.txt"])
        for name in ("manifest.json", "files.txt", "series.csv"):
            content = (self.folder / "whole" / name).read_bytes()
            for damage, torn in (("torn", content[:len(content) // 2]), ("empty", b""),
                                 ("turned", bytes([*content[:40], content[40] ^ 8, *content[41:]]))):
                with self.subTest(f"{name} {damage}"):
                    shutil.copytree(self.folder / "whole", self.folder / "r")
                    (self.folder / "r" / name).write_bytes(torn)
                    before = tree(self.folder / "r")
                    done = self.run_talus("run", "case.toml", "--out", "r", "--resume", *SHORT)
                    self.assertIn(done.returncode, (0, 2, 4), done.stderr)
                    if done.returncode:
                        self.assertRegex(done.stderr, r"r(/\S+)?: ")
                    for kept in ("notes.txt", "snapshots/particles_0000.vtkhdf"):
                        self.assertEqual(tree(self.folder / "r")[kept], before[kept])
                    shutil.rmtree(self.folder / "r")

    def test_a_list_is_whole_after_kills(self):
        """Killed at any moment, every file of the run is in its list, and the list alone decides."""
        arguments = ("--set", "output.snapshots=0.02 ms", "--set", "output.checkpoint_interval=1 ms")
        for part in (1, 30, 80):
            with self.subTest(part):
                process = self.start("run", "case.toml", "--out", "r", *arguments)
                self.wait_for_rows(process, "r", part)
                self.kill(process)
                listed = {line[9:] for line in (self.folder / "r/files.txt").read_text().splitlines()[1:]}
                there = {name.removesuffix(".part") for name in tree(self.folder / "r")}
                self.assertLessEqual(there, listed | {"files.txt"})
                self.put("r")
                self.talus("run", "case.toml", "--out", "r", "--overwrite", *SHORT)
                self.assert_mine("r")
                self.assertEqual(json.loads((self.folder / "r/summary.json").read_text())["status"], "done")
                shutil.rmtree(self.folder / "r")


if __name__ == "__main__":
    unittest.main()
