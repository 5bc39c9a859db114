# SPDX-License-Identifier: Apache-2.0
"""What the program says about cases, and about points that others have made."""
import json
import tomllib
import unittest

from program import PROJECT, ProgramTest

# Three rows of five grains of 5 mm, 9 mm apart, and one grain alone, 0.2 m ahead.
ROWS = "x [mm],y [mm],radius [mm]\n" + "".join(f"{9 * i},{9 * j},5\n" for i in range(5) for j in range(3)) + "240,0,5\n"


def keys_of(table, prefix=""):
    """The dotted keys of a case."""
    for name, value in table.items():
        if isinstance(value, dict):
            yield from keys_of(value, f"{prefix}{name}.")
        else:
            yield prefix + name


class Schema(ProgramTest):
    def properties(self, model="cloud"):
        """Keys with their tables' names, and their schemas."""
        def walk(table, prefix):
            for name, entry in table["properties"].items():
                if entry["type"] == "object":
                    yield from walk(entry, f"{prefix}{name}.")
                else:
                    yield prefix + name, entry
        return dict(walk(json.loads(self.talus("schema", model).stdout), ""))

    def test_lists_the_keys_that_a_resolved_case_has(self):
        self.talus("run", "case.toml", "--out", "r")
        resolved = tomllib.loads(json.loads((self.folder / "r/manifest.json").read_text())["case"])
        keys = set(keys_of(resolved))
        properties = self.properties()
        optional = {"particles.length", "particles.width", "gravity.direction"}
        self.assertEqual(keys | optional, set(properties))
        for key, entry in properties.items():
            self.assertIn("description", entry, key)
            if key not in optional and "default" in entry:
                table, _, name = key.rpartition(".")
                self.assertEqual(type((resolved[table] if table else resolved)[name]), type(entry["default"]), key)

    def test_knows_every_key_of_every_case_in_the_project(self):
        cases = sorted((PROJECT / "cases").glob("*.toml"))
        self.assertGreater(len(cases), 3)
        for path in cases:
            case = tomllib.loads(path.read_text())
            properties = self.properties(case["model"])
            for key in keys_of(case):
                self.assertIn(key, properties, path.name)

    def test_cases_of_the_project_are_valid(self):
        for path in sorted((PROJECT / "cases").glob("*.toml")):
            self.talus("run", path, "--dry-run", "--out", "r")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["case.toml"])

    def test_cases_of_the_papers_rely_on_no_default(self):
        """Of what another default would change: law, stiffness, collisions, viscosity, method and step."""
        paths = [*(PROJECT / "cases").glob("yuu2011-*.toml"), *(PROJECT / "validation/exact/cases").glob("*.toml"),
                 *(PROJECT / "validation").glob("*/*.toml")]
        checked = 0
        for path in sorted(paths):
            case = tomllib.loads(path.read_text())
            if case.get("model") != "continuum":
                continue
            keys = set(keys_of(case))
            needed = {"law.name", "collisions.form", "sph.viscosity_alpha", "integration.method"}
            if "grains.material" in keys:
                needed.remove("law.name")
            self.assertLessEqual(needed, keys, path)
            self.assertTrue({"integration.courant", "integration.step"} & keys, path)
            if case.get("law", {}).get("name") == "critical-state":
                self.assertLessEqual({"law.critical-state.bulk_modulus", "law.critical-state.shear_modulus"}, keys, path)
            checked += 1
        self.assertGreater(checked, 20)

    def test_check_tells_keys_without_a_value(self):
        self.assertRegex(self.talus("check", "case.toml", "--all").stdout, r"particles\.length +- ")

    def test_reference_pages_are_those_of_this_program(self):
        for model in ("cloud", "continuum", "air"):
            page = PROJECT / f"docs/case-reference-{model}.md"
            self.assertEqual(page.read_text(), self.talus("schema", model, "--markdown").stdout,
                             f"{page} is stale: build/talus schema {model} --markdown > {page.relative_to(PROJECT)}")


class Analyze(ProgramTest):
    def quantities(self, *arguments):
        found = json.loads(self.talus("analyze", "points.csv", "--json", *arguments).stdout)
        return {name: entry["value"] for name, entry in found["quantities"].items()}, found["table"]

    def setUp(self):
        super().setUp()
        (self.folder / "points.csv").write_text(ROWS)

    def test_front(self):
        found, _ = self.quantities("--as", "front")
        self.assertAlmostEqual(found["front_x"], 0.24)

    def test_heads(self):
        found, table = self.quantities("--as", "heads")
        self.assertEqual((found["head_count"], len(table)), (1, 1))
        # All but the corners' neighbourhoods are above a quarter of the largest n'; the lone grain is not of the head.
        self.assertEqual(found["head_particles"], 15)
        self.assertAlmostEqual(found["head_width"], 0.028)

    def test_neighbours(self):
        found, _ = self.quantities("--as", "neighbours")
        # Four radii reach over two places of a row, and over one place of two rows and columns.
        places = [(i, j) for i in range(5) for j in range(3)]
        direct = [sum((i - k) ** 2 + (j - m) ** 2 <= 4 for k, m in places) - 1 for i, j in places] + [0]
        self.assertAlmostEqual(found["neighbours_mean"], sum(direct) / 16)
        self.assertEqual(found["neighbours_max"], max(direct))

    def test_histogram(self):
        found, table = self.quantities("--as", "histogram", "--column", "position_x", "--bins", "24")
        self.assertEqual((found["count"], found["least"], found["largest"]), (16, 0, 0.24))
        self.assertAlmostEqual(found["mean"], (3 * 0.09 + 0.24) / 16)
        self.assertEqual(sum(row["count"] for row in table), 16)
        self.assertEqual([row["count"] for row in table if row["count"]], [6, 3, 3, 3, 1])
        (self.folder / "points.csv").write_text("x [m],y [m]\n0,0\n1,0\n")
        self.assertEqual(self.quantities("--as", "histogram", "--column", "position_x")[0]["count"], 2, "without radii")
        self.assertIn("--radius", self.talus("analyze", "points.csv", "--as", "heads", status=2).stderr)

    def test_faults(self):
        self.assertIn("did you mean 'heads'?", self.talus("analyze", "points.csv", "--as", "haeds", status=2).stderr)
        self.assertIn("--as: missing", self.talus("analyze", "points.csv", status=2).stderr)
        (self.folder / "points.csv").write_text("x [m],y [m]\n0,0\n")
        self.assertIn("--radius", self.talus("analyze", "points.csv", "--as", "heads", status=2).stderr)
        self.talus("analyze", "none.csv", "--as", "heads", status=4)

    def test_run_folder_once_more(self):
        self.talus("run", "case.toml", "--out", "r")
        before = json.loads((self.folder / "r/summary.json").read_text())
        tables = {path.name: path.read_bytes() for path in (self.folder / "r/analysis").iterdir()}
        self.assertEqual(list(tables), ["front_speed.csv"])
        manifest = json.loads((self.folder / "r/manifest.json").read_text())
        self.assertEqual(before["instruction_set"], manifest["instruction_set"])
        for path in (self.folder / "r/analysis").iterdir():
            path.unlink()
        self.talus("analyze", "r")
        self.assertEqual(json.loads((self.folder / "r/summary.json").read_text()), before)
        self.assertEqual({path.name: path.read_bytes() for path in (self.folder / "r/analysis").iterdir()}, tables)


if __name__ == "__main__":
    unittest.main()
