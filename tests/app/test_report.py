# SPDX-License-Identifier: Apache-2.0
"""report.html: what it holds, where it is written, and the page in a browser."""
import base64
import json
import os
import re
import subprocess
import sys
import time
import unittest
import zlib
from pathlib import Path

import h5py
import numpy

import browser
from program import HOPPER, PROGRAM, PROJECT, ProgramTest

AIR = """[air]
enabled = true
cell = "10 mm"
[output]
snapshots = "2 ms"
pictures = true
"""
HAS_PAGE = "without the page" not in subprocess.run([PROGRAM, "report", "nowhere"], capture_output=True, text=True,
                                                    check=False).stderr
NO_PAGE = "this program was built without the page of reports (npm)"


class Page:
    """The data of a report, unpacked as the page unpacks it."""

    def __init__(self, path):
        self.text = Path(path).read_text(encoding="utf-8")
        self.header = json.loads(re.search(r'id="talus-header">(.*?)</script>', self.text, re.S).group(1))

    def bytes(self, block):
        return zlib.decompress(base64.b64decode(
            re.search(rf'id="talus-block-{block}">([^<]*)<', self.text).group(1)))

    def frames(self, packed, count):
        raw = numpy.frombuffer(self.bytes(packed["block"]), numpy.uint8).astype(numpy.uint16)
        half = len(raw) // 2
        codes = numpy.cumsum((raw[:half] | raw[half:] << 8).reshape(-1, count), axis=0, dtype=numpy.uint16)
        step = (packed["high"] - packed["low"]) / (packed["levels"] - 1)
        return packed["low"] + codes * step, step

    def numbers(self, block):
        raw = numpy.frombuffer(self.bytes(block), numpy.uint8).reshape(4, -1)
        return numpy.ascontiguousarray(raw.T).view("<f4").ravel()


@unittest.skipUnless(HAS_PAGE, NO_PAGE)
class Content(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.folder / "hopper.toml").write_text(HOPPER + AIR)

    def test_frames_are_those_of_the_snapshots(self):
        self.talus("run", "hopper.toml", "--out", "r")
        page = Page(self.folder / "r/report.html")
        run = page.header["runs"][0]
        frames = run["frames"]
        paths = sorted((self.folder / "r/snapshots").glob("particles_*.vtkhdf"))
        self.assertEqual(len(frames["time"]), len(paths))
        for n, path in enumerate(paths):
            with h5py.File(path) as file:
                order = numpy.argsort(file["VTKHDF/PointData/identity"][()])
                points = file["VTKHDF/Points"][()][order]
                velocity = numpy.linalg.norm(file["VTKHDF/PointData/velocity"][()][order], axis=1)
            self.assertEqual(frames["count"], len(points))
            for axis in range(3):
                values, step = page.frames(frames["position"][axis], len(points))
                self.assertLessEqual(abs(values[n] - points[:, axis]).max(), 0.51 * step + 1e-8)
            values, step = page.frames(next(f for f in frames["fields"] if f["name"] == "velocity"), len(points))
            self.assertLessEqual(abs(values[n] - velocity).max(), 0.51 * step + 1e-9)
        self.assertIn("velocity", frames["air"])
        self.assertEqual(sum("until" in wall for wall in run["scene"]["walls"]), 1)

        # Every quantity of the summary, with its value and the text of the list of measures.
        summary = json.loads((self.folder / "r/summary.json").read_text())
        self.assertEqual({q["name"]: q["values"][0] for q in run["quantities"]},
                         {name: q["value"] for name, q in summary["quantities"].items()})
        self.assertIn("upward force of floor and plate", page.header["definitions"]["floor_stress_settled"])
        self.assertEqual(run["regime"], summary["regime"])
        self.assertTrue(run["regime"])

        # The key results of the summary, and a time at which the gate is open.
        self.assertEqual([line["title"] for line in run["key_results"]], [line["title"] for line in summary["key_results"]])
        self.assertEqual(run["key_results"][0]["title"], "Flow")
        self.assertGreaterEqual(run.get("telling_time", 0), 0)
        self.assertEqual(run["case"], json.loads((self.folder / "r/manifest.json").read_text())["case"])
        series = next(t for t in run["tables"] if t["name"] == "series")
        times = page.numbers(series["columns"][0]["block"])
        self.assertEqual(len(times), series["rows"])
        self.assertIn("report.html", (self.folder / "r/files.txt").read_text())

        # The same run gives the same page; thinned ones say of how many.
        self.talus("report", "r", "--out", "again.html")
        self.assertEqual((self.folder / "again.html").read_bytes(), (self.folder / "r/report.html").read_bytes())
        self.talus("report", "r", "--out", "thin.html", "--particles", 40, "--frames", 3)
        thin = Page(self.folder / "thin.html").header["runs"][0]["frames"]
        self.assertEqual(len(thin["time"]), 3)
        self.assertLess(abs(thin["count"] - 40), 8)
        self.assertEqual(thin["of_particles"], frames["count"])

    def test_an_ensemble_is_bands(self):
        self.talus("ensemble", "case.toml", "--members", 3, "--jobs", 2, "--out", "e")
        run = Page(self.folder / "e/report.html").header["runs"][0]
        self.assertEqual((run["name"], run["members"]), ("all", 3))
        self.assertTrue(all(len(q["values"]) <= 3 for q in run["quantities"]))
        columns = {c["name"] for t in run["tables"] for c in t["columns"]}
        self.assertTrue({"front_speed_mean", "front_speed_deviation"} <= columns, columns)
        self.assertFalse((self.folder / "e/all/seed_0003/report.html").exists())
        made = (self.folder / "e/report.html").read_bytes()
        self.talus("report", "e")
        self.assertEqual(len(Page(self.folder / "e/report.html").header["runs"][0]["quantities"]), len(run["quantities"]))
        self.assertGreater(len(made), 100_000)

    def test_a_signal_while_a_done_run_is_compared_takes_only_the_comparison(self):
        stand_in = self.folder / "bin/python3"
        stand_in.parent.mkdir()
        stand_in.write_text('#!/bin/sh\ncase "$*" in *gathered*) kill -TERM $PPID; exit 1;; esac\n')
        stand_in.chmod(0o755)
        said = self.talus("run", "case.toml", "--out", "r", env={**os.environ, "PATH": str(stand_in.parent)}).stdout
        self.assertIn("Done", said)
        self.assertEqual(json.loads((self.folder / "r/summary.json").read_text())["status"], "done")
        self.assertEqual(Page(self.folder / "r/report.html").header["comparisons"], [])

    def test_what_is_no_report_is_not_replaced(self):
        self.talus("run", "case.toml", "--out", "r", "--set", "output.report=false")
        self.assertFalse((self.folder / "r/report.html").exists())
        (self.folder / "mine.html").write_text("mine")
        said = self.talus("report", "r", "--out", "mine.html", status=4).stderr
        self.assertIn("is there, and no report of Talus", said)
        self.assertEqual((self.folder / "mine.html").read_text(), "mine")
        (self.folder / "empty").mkdir()
        self.assertIn("holds no finished run", self.talus("report", "empty", status=2).stderr)


@unittest.skipUnless(HAS_PAGE, NO_PAGE)
@unittest.skipUnless(browser.find(), "there is no chromium")
class InABrowser(ProgramTest):
    def open(self, path, **options):
        page = browser.Browser(**options)
        self.addCleanup(page.close)
        page.open(path)
        page.wait_for("document.documentElement?.dataset.ready === 'all'")
        return page

    def assert_quiet(self, page):
        """No error in the console, nothing asked of the network."""
        self.assertEqual(page.errors, [])
        self.assertEqual([url for url in page.requests if not url.startswith(("file:", "data:", "blob:"))], [])

    def shot(self, page, name):
        """Kept where TALUS_SCREENSHOTS says."""
        if "TALUS_SCREENSHOTS" in os.environ:
            page.screenshot(Path(os.environ["TALUS_SCREENSHOTS"]) / f"{name}.png")

    def test_loads_of_walls_stand_beside_their_estimates(self):
        self.talus("run", PROJECT / "cases/silo-cone.toml", "--set", "bed.spacing=6 mm", "--set", "gate.opens=at-time",
                   "--set", "gate.time=20 ms", "--set", "run.end=60 ms", "--out", "silo")
        loads = Page(self.folder / "silo/report.html").header["runs"][0]["wall_loads"]
        self.assertEqual(loads["patch"], [1, 1, 2, 3])
        self.assertGreater(loads["en_pressure_discharge"][2], loads["en_pressure_filling"][2])
        self.assertIsNone(loads["en_pressure_filling"][3], "the gate under a cone has no formula")
        page = self.open(self.folder / "silo/report.html")
        self.assertIn("EN 1991-4, discharge", page.evaluate("document.getElementById('wall-loads').textContent"))
        self.assertGreater(page.evaluate("document.querySelectorAll('#wall-loads polyline').length"), 3)
        self.assertFalse(page.evaluate("document.getElementById('wall-loads').hidden"))
        self.assert_quiet(page)
        (self.folder / "hopper.toml").write_text(HOPPER + AIR)
        self.talus("run", "hopper.toml", "--out", "r")
        page = self.open(self.folder / "r/report.html")
        self.assertTrue(page.evaluate("document.getElementById('wall-loads').hidden"), "without a vessel")

    def test_the_page_does_what_it_says(self):
        (self.folder / "hopper.toml").write_text(HOPPER + AIR)
        self.talus("run", "hopper.toml", "--out", "r")
        page = self.open(self.folder / "r/report.html")
        canvas = "document.getElementById('canvas').toDataURL()"
        seen = [page.evaluate(canvas)]
        results = page.evaluate("document.getElementById('key-results-body').textContent")
        self.assertRegex(results, "Flow.*Steady discharge.*Pressure at rest, plate")
        top = "document.getElementById('{}').getBoundingClientRect().top"
        self.assertLess(page.evaluate(top.format("key-results")), page.evaluate(top.format("view")), "they stand first")
        clock = "document.getElementById('clock').textContent"
        before = page.evaluate(clock)

        # The slider, the field, the map, the direction: each changes the picture.
        frames = page.evaluate("Number(document.getElementById('time').max)")
        for change in (f"time.value = {frames}; time.dispatchEvent(new Event('input'))",
                       "field.value = 'pressure'; field.dispatchEvent(new Event('change'))",
                       "map.value = 'cividis'; map.dispatchEvent(new Event('change'))",
                       "document.querySelector('#views button:last-child').click()"):
            names = "".join(f"const {i} = document.getElementById('{i}');" for i in ("time", "field", "map"))
            drawn_anew = f"for (let n = 0; n < 50 && {canvas} === drawn; ++n) await new Promise(done => setTimeout(done, 100));"
            page.evaluate(f"(async () => {{ {names} const drawn = {canvas}; {change}; {drawn_anew} }})()")
            seen.append(page.evaluate(canvas))
        self.assertEqual(len(set(seen)), len(seen))
        self.assertNotEqual(page.evaluate(clock), before)
        self.assertIn("pressure in Pa", page.evaluate("document.getElementById('legend').textContent"))

        # A particle is read.
        page.key("1")
        left, top, width, height = page.box("#stage")
        reading = "document.getElementById('reading').hidden ? '' : document.getElementById('reading').textContent"
        found = ""
        for share in (0.75, 0.7, 0.65, 0.6, 0.55, 0.5):
            page.mouse("mouseMoved", left + 0.47 * width, top + share * height)
            found = found or page.evaluate(reading)
        self.assertRegex(found, r"particle\d+.*mm.*pressure")

        # The keys: play, then the first frame.
        page.evaluate("document.getElementById('canvas').focus()")
        page.key("Home")
        first = page.evaluate(clock)
        self.assertNotEqual(first, before, "it opens with the gate open, not at the first frame")
        page.key(" ", " ")
        self.assertEqual(page.evaluate("document.getElementById('play').textContent"), "Pause")
        page.key(" ", " ")

        # A plot is zoomed by dragging; a click sets the time.
        tick = "document.querySelectorAll('#plots figure').length"
        self.assertGreaterEqual(page.evaluate(tick), 2)
        picture = "document.querySelector('#plots canvas').toDataURL()"
        left, top, width, height = page.box("#plots .u-over")
        page.click(left + 0.9 * width, top + 0.5 * height)
        self.assertNotEqual(page.evaluate(clock), before)
        whole = page.evaluate(picture)
        page.drag((left + 0.3 * width, top + 0.5 * height), (left + 0.6 * width, top + 0.5 * height))
        page.wait_for(f"{picture} !== {json.dumps(whole)}", 5)

        # The picture is saved.
        page.evaluate("document.getElementById('save').click()")
        limit = time.monotonic() + 20
        while not (saved := list(Path(page.downloads).glob("*.png"))) and time.monotonic() < limit:
            page.evaluate("1")
            time.sleep(0.05)
        self.assertTrue(saved, "no picture was saved")
        self.assertEqual(saved[0].read_bytes()[:4], b"\x89PNG")
        self.shot(page, "report")

        # On paper what is folded is printed too, and nothing that only a screen can do.
        page.evaluate("addEventListener('beforeprint', () => { window.unfolded ="
                      " [...document.querySelectorAll('details')].every(d => d.open); })")
        printed = page.pdf()
        self.assertEqual(printed[:5], b"%PDF-")
        self.assertGreater(len(re.findall(rb"/Type /Page\b", printed)), 1)
        self.assertTrue(page.evaluate("window.unfolded"))
        self.assertFalse(page.evaluate("document.querySelector('#case details').open"))
        if "TALUS_SCREENSHOTS" in os.environ:
            (Path(os.environ["TALUS_SCREENSHOTS"]) / "report.pdf").write_bytes(printed)
        self.assert_quiet(page)

    def test_two_runs_share_the_time_and_without_webgl_pictures_stand_in(self):
        self.talus("run", "case.toml", "--out", "a", "--set", "output.pictures=true")
        self.talus("run", "case.toml", "--out", "b", "--set", "particles.count=30")
        self.talus("report", "a", "b")
        page = self.open(self.folder / "report.html")
        self.assertEqual(page.evaluate("document.querySelectorAll('.panel-label').length"), 2)
        self.assertIn("particles.count", page.evaluate("document.getElementById('case').textContent"))
        # One slider moves both: each half of the canvas changes.
        half = """((side) => { const from = document.getElementById("canvas"), to = document.createElement("canvas");
            to.width = from.width / 2; to.height = from.height;
            to.getContext("2d").drawImage(from, -side * to.width, 0); return to.toDataURL(); })"""
        before = [page.evaluate(f"{half}({side})") for side in (0, 1)]
        page.evaluate("(async () => { const time = document.getElementById('time'); time.value = time.max;"
                      "time.dispatchEvent(new Event('input')); await new Promise(done => setTimeout(done, 150)); })()")
        for side in (0, 1):
            self.assertNotEqual(page.evaluate(f"{half}({side})"), before[side])
        self.shot(page, "two-runs")
        self.assert_quiet(page)
        page = browser.Browser(webgl=False)
        self.addCleanup(page.close)
        page.open(self.folder / "report.html")
        page.wait_for("document.documentElement?.dataset.ready === 'all'")
        self.assertTrue(page.evaluate("document.getElementById('stage').hidden && document.getElementById('stills').open"))
        self.assertGreaterEqual(page.evaluate("document.querySelectorAll('#stills img').length"), 1)
        self.assertGreater(page.evaluate("document.querySelectorAll('#summary tbody tr').length"), 5)


if __name__ == "__main__":
    for reason, missing in ((NO_PAGE, not HAS_PAGE), ("there is no chromium", not browser.find())):
        if missing:
            print(f"skipped: {reason}")
    result = unittest.main(exit=False).result
    if result.wasSuccessful() and len(result.skipped) == result.testsRun:
        sys.exit(77)  # ctest: skipped
    sys.exit(not result.wasSuccessful())
