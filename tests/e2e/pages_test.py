#!/usr/bin/env python3
"""The pages that lucerna writes: well-formed, whole without a network, and with the numbers that --json prints.

Usage: pages_test.py PROGRAM [unittest arguments]
"""
import base64
import html.parser
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = ""
RENDER = ["render", "builtin:atrium?lights=2", "--size", "64x36"]
VOID = {"meta", "img", "input", "br", "link", "hr"}  # elements without an end


class Page(html.parser.HTMLParser):
    """Collects the elements; `faults` are ends that fit no beginning, doubled ids, and addresses."""

    def __init__(self, text):
        super().__init__()
        self.open, self.faults, self.images, self.cells, self.ids = [], [], {}, [], set()
        self.feed(text)
        self.close()
        if self.open:
            self.faults.append(f"never closed: {self.open}")

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        if tag not in VOID:
            self.open.append(tag)
        if "id" in attributes:
            if attributes["id"] in self.ids:
                self.faults.append(f"two elements have the id {attributes['id']}")
            self.ids.add(attributes["id"])
        for name in ("src", "href"):
            if not attributes.get(name, "data:").startswith("data:"):
                self.faults.append(f"{tag} {name}={attributes[name]}")
        if tag == "img":
            self.images[attributes.get("id")] = attributes["src"]
        if tag in ("td", "th"):
            self.cells.append("")

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"</{tag}> closes nothing")

    def handle_data(self, data):
        if self.open and self.open[-1] in ("td", "th"):
            self.cells[-1] += data

    def picture(self, name):
        return base64.b64decode(self.images[name].removeprefix("data:image/png;base64,"))


class PagesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lucerna-pages-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def lucerna(self, *arguments):
        run = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120,
                             cwd=self.folder, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def page(self, name):
        page = Page((self.folder / name).read_text())
        self.assertEqual(page.faults, [])
        return page

    def compare_page(self, *files):
        numbers = json.loads(self.lucerna("compare", *files, "--json", "--html", "page.html", "--heatmap", "e.png"))
        page = self.page("page.html")
        for number in (*numbers["flip"].values(), numbers["ssim"], numbers["rmse"]):
            self.assertIn(f"{number:.6f}", page.cells)
        self.assertIn(f"{numbers['psnr']:.3f} dB", page.cells)
        self.assertEqual(page.picture("error"), (self.folder / "e.png").read_bytes())
        return page

    def assert_shows(self, page, name, file):
        (self.folder / "shown.png").write_bytes(page.picture(name))
        self.assertEqual(json.loads(self.lucerna("compare", file, "shown.png", "--ldr", "--json"))["flip"]["max"], 0)

    def test_compare_holds_both_pictures_the_error_and_the_numbers(self):
        self.lucerna(*RENDER, "-o", "a<b>&.png")
        self.lucerna(*RENDER, "--exposure", "-2", "-o", "b.png")
        page = self.compare_page("a<b>&.png", "b.png")
        self.assert_shows(page, "reference", "a<b>&.png")
        self.assert_shows(page, "test", "b.png")
        self.assertNotIn("test-values", page.ids)

    def test_compare_of_linear_pictures_holds_their_values(self):
        self.lucerna(*RENDER, "-o", "a.exr")
        self.lucerna(*RENDER, "-o", "b.hdr")
        page = self.compare_page("a.exr", "b.hdr")
        self.assertLessEqual({"reference-values", "test-values", "flip-values"}, page.ids)

    def test_profile_holds_every_pass(self):
        for name in ("p.json", "p.html", "p.md"):
            self.lucerna(*RENDER, "--frames", 3, "-o", "f-%d.png", "--profile", name)
        passes = [row["pass"] for row in json.loads((self.folder / "p.json").read_text())["frames"][2]["passes"]]
        cells = self.page("p.html").cells
        table = [line.split(" | ")[0].removeprefix("| ") for line in (self.folder / "p.md").read_text().splitlines()
                 if line.startswith("| ")]
        self.assertEqual([cell for cell in cells if cell in passes], passes)
        self.assertEqual(table, ["pass", *passes, "**whole frame**"])


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
