#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The documents as a site: MkDocs builds it without a warning, and no link within it leads nowhere."""
import html.parser
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Links(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.links = []

    def handle_starttag(self, tag, attributes):
        self.links += [value for name, value in attributes if name in ("href", "src") and value]


class Site(unittest.TestCase):
    def test_it_is_built_and_its_links_lead_somewhere(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="talus-site-"))
        self.addCleanup(shutil.rmtree, folder)
        done = subprocess.run([ROOT / "tools/build_site", folder / "site"], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        pages = sorted((folder / "site").rglob("*.html"))
        self.assertGreater(len(pages), 40)
        lost = []
        for page in pages:
            if page.name == "404.html":
                continue
            links = Links()
            links.feed(page.read_text(encoding="utf-8"))
            for link in links.links:
                parts = urllib.parse.urlsplit(link)
                if parts.scheme or parts.netloc or not parts.path:
                    continue
                target = (page.parent / urllib.parse.unquote(parts.path)).resolve()
                if not target.exists():
                    lost.append(f"{page.relative_to(folder)}: {link}")
        self.assertEqual(lost, [])
        index = (folder / "site/index.html").read_text(encoding="utf-8")
        for name in ("Gallery", "Troubleshooting by error message", "Talus"):
            self.assertIn(name, index)


if __name__ == "__main__":
    if not shutil.which("mkdocs"):
        sys.exit(77)
    unittest.main()
