#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The checks of tools/ find what is planted."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

import check_documents  # noqa: E402
import check_layers  # noqa: E402


class Tree(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        self.write("src/base/a.hpp", "#pragma once\n")
        self.write("src/models/cloud/m.hpp", '#include "base/a.hpp"\n')

    def tearDown(self):
        self.folder.cleanup()

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path


class Lint(Tree):
    """clang-tidy on a tree of one file, built by ninja as CMake would have it."""

    def lint(self, source="../src/base/a.cpp"):
        build = self.root / "build"
        self.write(".clang-tidy", (ROOT / ".clang-tidy").read_text(encoding="utf-8"))
        self.write("build/build.ninja", "rule cxx\n  command = c++ -MMD -MF $out.d -I../src -c $in -o $out\n"
                   f"  depfile = $out.d\n  deps = gcc\nbuild a.o: cxx {source}\n")
        path = str((build / source).resolve())
        command = f"c++ -I{self.root}/src -o a.o -c {path}"
        self.write("build/compile_commands.json", json.dumps([{"directory": str(build), "command": command, "file": path}]))
        subprocess.run(["ninja", "-C", str(build)], check=True, capture_output=True)
        return subprocess.run([str(ROOT / "tools/check_lint.py"), "--root", str(self.root)],
                              capture_output=True, text=True)

    def test_a_finding_fails_and_a_clean_file_is_looked_at_once(self):
        self.write("src/base/a.cpp", '#include "base/a.hpp"\nint Halve(int x) { return x / 2; }\n')
        done = self.lint()
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("readability-identifier-naming", done.stdout)
        self.write("src/base/a.cpp", '#include "base/a.hpp"\nint halve(int x) { return x / 2; }\n')
        self.assertIn("1 files, 1 looked at, 0 with findings", self.lint().stdout)
        self.assertIn("1 files, 0 looked at, 0 with findings", self.lint().stdout)

    def test_the_files_of_a_folder_that_is_compiled_as_one_are_looked_at(self):
        self.write("src/base/a.cpp", "int one() { return 1; }\n")
        self.write("src/base/b.cpp", "int Two() { return 2; }\n")
        self.write("build/src/unity.cxx", '#include "base/a.cpp"\n#include "base/b.cpp"\n')
        done = self.lint("src/unity.cxx")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"src/base/b.cpp:1:.*readability-identifier-naming")
        self.write("src/base/b.cpp", "int two() { return 2; }\n")
        self.assertIn("1 files, 1 looked at, 0 with findings", self.lint("src/unity.cxx").stdout)

    def test_a_change_of_a_header_is_looked_at(self):
        self.write("src/base/a.cpp", '#include "base/a.hpp"\nint one() { return 1; }\n')
        self.assertEqual(self.lint().returncode, 0)
        self.write("src/base/a.hpp", "#pragma once\nstruct number {};\n")
        done = self.lint()
        self.assertEqual(done.returncode, 1)
        self.assertIn("a.hpp", done.stdout)


class Layers(Tree):
    def test_a_clean_tree_has_no_problem(self):
        for check in check_layers.CHECKS:
            self.assertEqual(check(self.root), [], check.__name__)

    def test_an_upward_include_is_found(self):
        self.write("src/base/b.cpp", '\n#include "models/cloud/m.hpp"\n')
        self.assertRegex(check_layers.check_layers(self.root)[0], r"src/base/b.cpp:2: base must not include models")

    def test_models_do_not_include_io(self):
        self.write("src/io/w.hpp", "")
        self.write("src/models/cloud/n.cpp", '#include "io/w.hpp"\n')
        self.assertEqual(len(check_layers.check_layers(self.root)), 1)

    def test_an_include_that_is_not_there_is_found(self):
        self.write("src/base/b.cpp", '#include "a.hpp"\n')
        self.assertIn("not below src/", check_layers.check_layers(self.root)[0])

    def test_messages_outside_their_folder_are_found(self):
        self.write("src/ranks/petsc/p.cpp", "#include <petscsf.h>\n")
        self.assertEqual(check_layers.check_messages(self.root), [])
        self.write("src/ranks/r.hpp", "#include <mpi.h>\n")
        self.assertRegex(check_layers.check_messages(self.root)[0], r"src/ranks/r.hpp:1: <mpi.h>")

    def test_run_that_names_a_model_is_found(self):
        self.write("src/run/r.cpp", "\ncloud::Parameters p;\n")
        self.assertRegex(check_layers.check_run_names_no_model(self.root)[0], r"src/run/r.cpp:2: .*cloud")

    def test_an_unnamed_name_that_hides_an_included_one_is_found(self):
        self.write("src/base/a.hpp", "namespace talus {\ndouble mean(double x);\n}\n")
        self.write("src/base/b.cpp", "namespace talus {\nnamespace {\ndouble half(double x) {\n  return x / 2;\n}\n"
                   "double mean(double x) {\n  return half(x);\n}\n}  // namespace\n}\n")
        used = "namespace talus {\ndouble twice(double x) {\n  return 2 * mean(x);  // half of\n}\n}\n"
        self.write("src/base/c.cpp", used)
        self.assertRegex(check_layers.check_unnamed_names(self.root)[0], r"src/base/b.cpp:1: mean.* hides .* c.cpp")
        self.write("src/base/c.cpp", "namespace {\ndouble mean(double x);\n}\n" + used)
        self.assertEqual(check_layers.check_unnamed_names(self.root), [])

    def test_a_cycle_is_found(self):
        self.write("src/base/c.hpp", '#include "base/d.hpp"\n')
        self.write("src/base/d.hpp", '#include "base/c.hpp"\n')
        self.assertIn("includes itself", check_layers.check_cycles(self.root)[0])

    def test_a_circle_among_the_folders_of_app_is_found(self):
        self.write("src/app/one/a.hpp", "")
        self.write("src/app/one/a.cpp", '#include "app/two/b.hpp"\n')
        self.write("src/app/two/b.hpp", '#include "app/three/c.hpp"\n')
        self.write("src/app/three/c.hpp", "")
        self.write("src/app/run_command.cpp", '#include "app/one/a.hpp"\n')
        self.assertEqual(check_layers.check_app_folders(self.root), [])
        self.write("src/app/three/c.cpp", '\n#include "app/one/a.hpp"\n')
        self.assertIn(
            "src/app/one/a.cpp:1: includes app/two/b.hpp, which leads back to its own folder: "
            "src/app/two/b.hpp:1: includes app/three/c.hpp; src/app/three/c.cpp:2: includes app/one/a.hpp",
            check_layers.check_app_folders(self.root),
        )

    def test_folders_of_app_do_not_include_the_commands_that_include_them(self):
        self.write("src/app/commands.hpp", "")
        self.write("src/app/one/a.hpp", '#include "app/commands.hpp"\n')
        self.write("src/app/run_command.cpp", '#include "app/one/a.hpp"\n')
        self.assertEqual(len(check_layers.check_app_folders(self.root)), 2)

    def test_a_template_header_behind_an_instruction_set_file_is_found(self):
        self.write("src/base/v.hpp", "#include <vector>\n")
        self.write("src/models/cloud/sum_for_set.cpp", '#include "base/v.hpp"\n')
        self.assertRegex(check_layers.check_instruction_set_files(self.root)[0], r"src/base/v.hpp:1: <vector>")

    def test_a_long_file_needs_a_reason(self):
        self.write("src/base/long.cpp", "\n" * 401)
        self.assertIn("401 lines", check_layers.check_lengths(self.root)[0])
        self.write("src/base/long.cpp", "// longer than 400 lines because it is a table\n" + "\n" * 400)
        self.assertEqual(check_layers.check_lengths(self.root), [])


class Documents(Tree):
    def documents(self):
        return sorted(self.root.rglob("*.md"))

    def test_prose_wider_than_a_page_is_found(self):
        wide = "word " * 21
        self.write("docs/a.md", f"{wide}\n\n| {wide} |\n\n    {wide}\n\n```\n{wide}\n```\n`{wide}`\n")
        self.assertEqual(
            list(check_documents.check_width(self.root, self.documents())),
            ["docs/a.md:1: the line has 105 characters; wrap at 100"],
        )

    def test_a_broken_link_is_found(self):
        self.write("docs/a.md", "[good](../src/base/a.hpp) [web](https://x.org) [part](#part)\n\n[bad](b.md)\n")
        self.assertEqual(
            list(check_documents.check_links(self.root, self.documents())),
            ["docs/a.md:3: the link b.md leads nowhere"],
        )

    def test_links_in_code_are_no_links(self):
        self.write("docs/a.md", "```\n[bad](b.md)\n```\n")
        self.assertEqual(list(check_documents.check_links(self.root, self.documents())), [])

    def test_documents_that_are_too_long_together_are_found(self):
        limit = check_documents.MAX_WORDS
        self.write("docs/a.md", "word " * 50_000)
        self.assertEqual(list(check_documents.check_length(self.root, self.documents())), [])
        self.write("docs/b.md", "word " * (limit - 49_999))
        self.assertEqual(list(check_documents.check_length(self.root, self.documents())),
                         [f"{self.root.name}: all documents together have {limit + 1} words, at most {limit}"])

    def test_a_word_that_was_replaced_is_found(self):
        self.write("tools/words.csv", "phrase,in its place\nolden days,the past\nOldName,NewName\n")
        self.write("docs/a.md", "Olden days it is quiet.\nGolden days.\n")
        self.write("src/base/a.hpp", "struct OldName {};\nstruct OldNames {};\n")
        subprocess.run(["git", "init", "-q", str(self.root)], check=True)
        subprocess.run(["git", "-C", str(self.root), "add", "."], check=True)
        self.assertEqual(sorted(check_documents.check_words(self.root)),
                         ['docs/a.md:1: "Olden days": the past', 'src/base/a.hpp:1: "OldName": NewName'])

    def test_a_path_that_is_not_there_is_found(self):
        self.write("ARCHITECTURE.md", "`src/base/a.hpp` and `src/base/gone.hpp` and `src/models/*/state.hpp`\n")
        self.assertEqual(
            list(check_documents.check_paths(self.root, self.documents())),
            ["ARCHITECTURE.md:1: there is no src/base/gone.hpp"],
        )

    def test_functions_and_tests_of_the_equations_are_looked_up(self):
        self.write("src/base/law.hpp", "double law(double x);\ndouble twice(double x) { return 2 * law(x); }\n")
        self.write("tests/base/test_law.cpp", "TEST(Law, Holds) {}\n")
        self.write("EQUATIONS.md", "| 1 | `law()` | `Law.Holds` |\n| 2 | `lore()` | `Law.Breaks` |\n")
        problems = list(check_documents.check_equations(self.root))
        self.assertEqual(len(problems), 2)
        self.assertIn("lore()", problems[0])
        self.assertIn("Law.Breaks", problems[1])


    def test_a_function_of_the_equations_that_nothing_calls_is_found(self):
        self.write("EQUATIONS.md", "| 1 | `law()` | |\n")
        self.write("src/base/law.hpp", "/// law() is fast.\nconstexpr double law(double x) {\n  return x;  // as law(x)\n}\n")
        self.write("src/base/law.cpp", "double& Class::law(int i) {}\nstd::vector<int> law(std::string s);\n")
        problem = ["EQUATIONS.md:1: nothing in src/ calls law()"]
        self.assertEqual(list(check_documents.check_equations(self.root)), problem)
        for use in ("y = law(x);", "f(x,\n  law(x));", "return sph::law(x);", "a * law(x);", "  law(x);", "each(team, law);"):
            self.write("src/base/user.cpp", f"void user() {{\n  {use}\n}}\n")
            self.assertEqual(list(check_documents.check_equations(self.root)), [], use)

    def test_another_version_than_that_of_the_build_is_found(self):
        self.write("CMakeLists.txt", "project(talus VERSION 1.2.3 LANGUAGES CXX)\n")
        self.write("python/talus/__init__.py", '"""Text."""\n__version__ = "1.2.3"\n')
        self.write("CITATION.cff", "cff-version: 1.2.0\nversion: 1.2.3\n")
        self.write("CHANGELOG.md", "# Changelog\n\n## 1.2.3\n\n## 1.2.2\n")
        self.assertEqual(list(check_documents.check_version(self.root)), [])
        self.write("CITATION.cff", "cff-version: 1.2.0\nversion: 1.2.2\n")
        self.assertEqual(list(check_documents.check_version(self.root)),
                         ["CITATION.cff:2: the version is 1.2.2, in CMakeLists.txt 1.2.3"])


class Packages(unittest.TestCase):
    def test_every_package_is_named_once_with_its_purpose(self):
        names = []
        for line in (ROOT / "packages.txt").read_text(encoding="utf-8").splitlines():
            if line and not line.startswith("#"):
                self.assertGreater(len(line.split(None, 1)), 1, line)
                names.append(line.split()[0])
        self.assertEqual(len(names), len(set(names)))

    def test_nothing_is_installed_where_all_is_there(self):
        result = subprocess.run([ROOT / "tools" / "install_packages"], capture_output=True, text=True, check=False)
        self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)


if __name__ == "__main__":
    unittest.main()
