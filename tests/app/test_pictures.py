# SPDX-License-Identifier: Apache-2.0
"""talus picture and talus movie: what they draw, what they say about names and times that are not there."""
import os
import shutil
import subprocess
import unittest

import h5py
import numpy

from program import HOPPER, PROGRAM, ProgramTest, scratch_folder

AIR = """[air]
enabled = true
cell = "10 mm"
[output]
snapshots = "0.5 ms"
pictures = false
report = false
"""
HAS_FFMPEG = shutil.which("ffmpeg") is not None


def size_of(path):
    """Width and height in the head of a PNG."""
    head = path.read_bytes()[:24]
    assert head[:8] == b"\x89PNG\r\n\x1a\n", path
    return int.from_bytes(head[16:20], "big"), int.from_bytes(head[20:24], "big")


class Pictures(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.once = scratch_folder()
        cls.addClassCleanup(shutil.rmtree, cls.once, ignore_errors=True)
        (cls.once / "hopper.toml").write_text(HOPPER + AIR)
        subprocess.run([PROGRAM, "run", "hopper.toml", "--out", "r", "--set", "run.end=3 ms"], cwd=cls.once, check=True,
                       capture_output=True)

    def setUp(self):
        super().setUp()
        shutil.copytree(self.once / "r", self.folder / "r")

    def test_one_time(self):
        self.talus("picture", "r", "--time", "0.002", "--color", "packing", "-o", "p.png")
        width, height = size_of(self.folder / "p.png")
        self.talus("picture", "r", "--time", "2 ms", "--color", "packing", "--out", "again.png")
        self.assertEqual((self.folder / "p.png").read_bytes(), (self.folder / "again.png").read_bytes())
        self.talus("picture", "r", "--time", "0.002", "--color", "packing", "--width", "300", "-o", "small.png")
        self.assertEqual(size_of(self.folder / "small.png")[0], 300)
        self.assertAlmostEqual(size_of(self.folder / "small.png")[1] / 300, height / width, delta=0.02)

    def test_pictures_differ_with_field_time_unit_range_view_and_arrows(self):
        drawn = {}
        for name, options in {
                "field": ["--color", "pressure"], "unit": ["--color", "pressure", "--unit", "kPa"],
                "range": ["--color", "pressure", "--range", "0,10"], "none": ["--color", "none"],
                "time": ["--color", "pressure", "--time", "0"], "view": ["--color", "pressure", "--view", "yz"],
                "component": ["--color", "velocity_z"], "air": ["--color", "air.pressure"],
                "arrows": ["--color", "none", "--arrows", "air"], "own": ["--color", "none", "--arrows", "velocity"],
                "title": ["--color", "pressure", "--title", "Another"]}.items():
            self.talus("picture", "r", *options, "-o", f"{name}.png")
            drawn[name] = (self.folder / f"{name}.png").read_bytes()
        self.assertEqual(len(set(drawn.values())), len(drawn))

    def test_a_strip_has_a_panel_for_each_time_and_run(self):
        self.talus("picture", "r", "--time", "0.002", "--color", "packing", "--title", "x", "-o", "one.png")
        self.talus("picture", "r", "--times", "0,1 ms,0.002", "--color", "packing", "--columns", "3", "-o", "strip.png")
        self.talus("picture", "r", "r", "--times", "0,1 ms,0.002", "--color", "packing", "--names", "a,b", "-o", "two.png")
        self.talus("picture", "r", "r", "r", "--time", "1 ms", "--columns", "1", "-o", "column.png")
        strip, two = size_of(self.folder / "strip.png"), size_of(self.folder / "two.png")
        self.assertEqual(strip[0], two[0])
        self.assertGreater(two[1], 1.6 * strip[1])
        width, height = size_of(self.folder / "column.png")
        self.assertGreater(height, 2 * width)

    def test_what_is_not_there_is_named_with_what_is(self):
        for options, words in {
                ("--color", "pakcing"): ["'packing'", "velocity_x", "pressure"],
                ("--color", "air.presure"): ["'air.pressure'", "air.velocity"],
                ("--arrows", "velocty"): ["'velocity'", "air"],
                ("--time", "3"): ["no snapshot near 3 s", "to 0.003"],
                ("--times", "0,7 ms"): ["no snapshot near 0.007 s"],
                ("--time", "early"): ["'early' is not a time (unit missing?)"],
                ("--time", "3 mm"): ["'3 mm' is not a time (unit missing?)"],
                ("--color", "packing", "--unit", "kPa"): ["no unit of packing"],
                ("--range", "2,1"): ["is no range"],
                ("--range", "2"): ["is no range"],
                ("--names", "a,b"): ["2 for 1 runs"],
                ("--view", "zx"): ["oblique"]}.items():
            said = self.refused("picture", "r", *options, "-o", "p.png")
            for word in words:
                self.assertIn(word, said, options)
        self.assertIn("missing", self.refused("picture", "r"))
        self.assertIn(".png", self.refused("picture", "r", "-o", "p.jpg"))
        self.assertIn("manifest.json", self.refused("picture", "nowhere", "-o", "p.png", status=4))
        self.assertIn("folder", self.refused("picture", "r", "-o", "nowhere/p.png", status=4))
        self.assertFalse((self.folder / "p.png").exists())
        self.talus("run", "case.toml", "--out", "cloud", "--set", "output.report=false")
        self.assertIn("has no air", self.refused("picture", "cloud", "--arrows", "air", "-o", "p.png"))
        self.talus("picture", "cloud", "--time", "0.001", "-o", "p.png")
        self.assertGreater(size_of(self.folder / "p.png")[0], 300)

    def refused(self, *arguments, status=2):
        ended = self.talus(*arguments, status=status)
        return ended.stdout + ended.stderr

    @unittest.skipUnless(HAS_FFMPEG, "there is no ffmpeg")
    def test_a_movie_has_a_frame_for_each_snapshot_and_the_same_bytes(self):
        snapshots = sorted((self.folder / "r/snapshots").glob("particles_*"))
        times = []
        for path in snapshots:
            with h5py.File(path) as file:
                times.append(file["VTKHDF/FieldData/time"][0])
        with open(self.folder / "r/series.csv", encoding="utf-8") as file:
            table = numpy.genfromtxt(file, delimiter=",", names=True, deletechars="")
        gate = float(table["gate_time_[s]"][-1])
        after = sum(time - gate >= 0 for time in times)
        for ending in ("mp4", "webm", "gif"):
            for name in ("a", "b"):
                self.talus("movie", "r", "r", "--color", "packing", "--from", "0", "--width", "301", "-o", f"{name}.{ending}")
            a = self.folder / f"a.{ending}"
            self.assertEqual(a.read_bytes(), (self.folder / f"b.{ending}").read_bytes())
            probe = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-select_streams", "v", "-show_entries",
                                    "stream=nb_read_frames,width", "-of", "default=nw=1", str(a)],
                                   capture_output=True, text=True, check=True).stdout
            self.assertIn(f"nb_read_frames={after}\n", probe + "\n")
            self.assertIn("width=301" if ending == "gif" else "width=302", probe)
        self.assertEqual([p.name for p in self.folder.glob("*.part")] + [p.name for p in self.folder.glob("*.said")], [])

    def test_without_ffmpeg_a_movie_says_what_to_install(self):
        ended = subprocess.run([PROGRAM, "movie", "r", "-o", "m.mp4"], cwd=self.folder, capture_output=True, text=True,
                               env={**os.environ, "PATH": str(self.folder)}, check=False)
        self.assertEqual(ended.returncode, 4)
        self.assertIn("apt-get install ffmpeg", ended.stderr)
        self.assertFalse((self.folder / "m.mp4").exists())

    @unittest.skipUnless(HAS_FFMPEG, "there is no ffmpeg")
    def test_a_movie_that_fails_leaves_nothing(self):
        fake = self.folder / "bin"
        fake.mkdir()
        (fake / "ffmpeg").write_text("#!/bin/sh\necho 'no such encoder' >&2\nexit 1\n")
        (fake / "ffmpeg").chmod(0o755)
        (self.folder / "m.mp4").write_text("older")
        ended = subprocess.run([PROGRAM, "movie", "r", "-o", "m.mp4"], cwd=self.folder, capture_output=True, text=True,
                               env={**os.environ, "PATH": f"{fake}:{os.environ['PATH']}"}, check=False)
        self.assertEqual(ended.returncode, 4, ended.stderr)
        self.assertIn("no such encoder", ended.stderr)
        self.assertEqual((self.folder / "m.mp4").read_text(), "older")
        self.assertEqual(len(list(self.folder.glob("m.mp4*"))), 1)
        self.assertIn("two snapshots", self.refused("movie", "r", "--from", "1", "-o", "m.mp4"))
        self.assertIn(".gif", self.refused("movie", "r", "-o", "m.avi"))


if __name__ == "__main__":
    unittest.main()
