#!/usr/bin/env python3
"""The pages that lucerna writes: well-formed, whole without a network, and with the numbers that --json prints.

Usage: pages_test.py PROGRAM [unittest arguments]
"""
import base64
import html.parser
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

import png

PROGRAM = ""
RENDER = ["render", "builtin:atrium?lights=2", "--size", "64x36"]
VOID = {"meta", "img", "input", "br", "link", "hr"}  # elements without an end
BROWSER = pathlib.Path(__file__).with_name("compare_page.js")


def exr(width, rows):
    """An OpenEXR file of RGB half floats without compression; rows of numbers, three a pixel."""
    def attribute(name, kind, value):
        return b"%s\0%s\0%s%s" % (name, kind, struct.pack("<i", len(value)), value)
    window = struct.pack("<4i", 0, 0, width - 1, len(rows) - 1)
    channels = b"".join(struct.pack("<2s4i", name, 1, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    head = b"v/1\1" + struct.pack("<i", 2) + b"".join((
        attribute(b"channels", b"chlist", channels), attribute(b"compression", b"compression", b"\0"),
        attribute(b"dataWindow", b"box2i", window), attribute(b"displayWindow", b"box2i", window),
        attribute(b"lineOrder", b"lineOrder", b"\0"), attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
        attribute(b"screenWindowCenter", b"v2f", bytes(8)),
        attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)))) + b"\0"
    lines = [struct.pack(f"<2i{3 * width}e", y, 6 * width, *row[2::3], *row[1::3], *row[0::3])
             for y, row in enumerate(rows)]
    first = len(head) + 8 * len(rows)
    places = [first + y * len(lines[0]) for y in range(len(rows))]
    return head + struct.pack(f"<{len(rows)}Q", *places) + b"".join(lines)


def halves(picture):
    """The numbers in a picture of the page: high bytes in the upper half, low bytes in the lower."""
    _, _, pixels = png.read(picture)
    values = [value for pixel in pixels for value in pixel]
    middle = len(values) // 2
    return [struct.unpack(">e", bytes(pair))[0] for pair in zip(values[:middle], values[middle:])]


class Page(html.parser.HTMLParser):
    """Collects the elements; `faults` are ends that fit no beginning, doubled ids, and addresses."""

    def __init__(self, text):
        super().__init__()
        self.open, self.faults, self.images, self.cells, self.ids = [], [], {}, [], set()
        self.views, self.data, self.script = [], "", ""
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
        if "data-view" in attributes:
            self.views.append(attributes["data-view"])
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
        if self.open and self.open[-1] == "script":  # the data stand before the script
            self.data, self.script = self.script, data

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

    def visit(self, page):
        """What a visitor sees, by compare_page.js and the program's own engine of scripts."""
        def rgba(name):
            width, height, pixels = png.read(page.picture(name))
            return {"width": width, "height": height,
                    "bytes": [value for pixel in pixels for value in (*(pixel if len(pixel) == 3 else 3 * pixel), 255)]}
        shown = {"ids": sorted(page.ids), "views": page.views, "data": page.data,
                 "pictures": {name: rgba(name) for name in page.images if name != "legend"}}
        # Pipelines are the scripts that the program runs; the name of this one is what was seen.
        (self.folder / "visit.js").write_text(
            f"{BROWSER.read_text()}\nfunction script(window, document, setInterval) {{{page.script}\n"
            f"return {{read, floatOfHalf}}; }}\n"
            f"pipeline({{name: JSON.stringify(visit({json.dumps(shown)}, script))}});\n"
            'pass("Cull");\npass("GBuffer");\npass("ShowGBuffer");\n')
        return json.loads(json.loads(self.lucerna("pipeline", "print", "visit.js", "--json"))["name"])

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

    def test_the_script_of_compare_names_bytes(self):
        self.lucerna(*RENDER, "-o", "a.png")
        self.lucerna(*RENDER, "--exposure", "-2", "-o", "b.png")
        page = self.compare_page("a.png", "b.png")
        seen = self.visit(page)
        pictures = [png.read((self.folder / file).read_bytes())[2] for file in ("a.png", "b.png")]
        for name, pixels in zip(("reference", "test"), pictures):
            self.assertEqual(seen["read"][name], [str(value) for pixel in pixels for value in (*pixel, 255)])
        a, b = (pixels[1] for pixels in pictures)  # where the visitor points
        told = [[str(value) for value in row] for row in (a, b, (y - x for x, y in zip(a, b)))]
        self.assertEqual([row[:3] for row in seen["told"]], told)
        self.assertFalse(seen["exposure"])
        self.assertNotIn("exposed", seen)

    def test_compare_of_linear_pictures_holds_their_values(self):
        reference = [[1, -2, 0.1, 65504, 2.0**-14, 2.0**-24, 0.5, 0.25, 100], [0, 0.75, 3, 1 / 3, 1, 1, 7, 8, 9]]
        test = [[value / 2 for value in row] for row in reference]
        (self.folder / "a.exr").write_bytes(exr(3, reference))
        (self.folder / "b.exr").write_bytes(exr(3, test))
        page = self.compare_page("a.exr", "b.exr")
        seen = self.visit(page)
        self.assertEqual([float(value) for value in seen["halves"] if value != "NaN"],
                         [value for value, in struct.iter_unpack(">e", struct.pack(">65536H", *range(65536)))
                          if not math.isnan(value)])
        for name, rows in (("reference", reference), ("test", test)):
            wanted = list(struct.unpack(">18e", struct.pack(">18e", *sum(rows, []))))
            self.assertEqual(halves(page.picture(f"{name}-values")), wanted)
            read = [float(value) for value in seen["read"][name]]
            self.assertEqual([value for i, value in enumerate(read) if i % 4 < 3], wanted)
        flip = halves(page.picture("flip-values"))
        self.assertEqual([float(value) for value in seen["read"]["flip"][::4]], flip)

        self.assertEqual(seen["where"], "x 1, y 0 (from the top left)")
        self.assertEqual(seen["told"], [["65500", "0.00006104", "5.96e-8", ""], ["32750", "0.00003052", "0", ""],
                                        ["-32750", "-0.00003052", "-5.96e-8", f"{flip[1]:.4f}"]])

    def test_the_script_of_compare_draws_what_is_asked_for(self):
        (self.folder / "a.exr").write_bytes(exr(3, [[0.5] * 9, [1] * 9]))
        (self.folder / "b.exr").write_bytes(exr(3, [[0.25] * 9, [1] * 9]))
        seen = self.visit(self.compare_page("a.exr", "b.exr"))
        # 200 x 160 pixels of the screen: 3 x 2 fit at 66.7 times.
        self.assertEqual(seen["fit"], [["reference", 0, (160 - 2 * 200 / 3) / 2, 200, 2 * 200 / 3]])
        self.assertEqual(seen["views"], {"1": ["reference"], "2": ["test"], "3": ["reference"],
                                         "4": ["reference", "test"], "5": ["error"]})
        self.assertEqual(seen["pressed"], {"1": ["reference"], "2": ["test"], "3": ["reference", "flip"],
                                           "4": ["slider"], "5": ["error"]})
        self.assertEqual((seen["flipped"], seen["other"]), ("test", "reference"))
        self.assertEqual(seen["one"], [["reference", 98.5, 79, 3, 2]])
        self.assertEqual(seen["moved"], [["reference", 97 + 10, 78 - 4, 6, 4]])
        grey = 255 * (1.055 * 0.25 ** (1 / 2.4) - 0.055), 255 * (1.055 * 0.5 ** (1 / 2.4) - 0.055)
        self.assertEqual(seen["exposed"], ["-1 EV", [value for shade in grey for _ in range(3)
                                                     for value in (*[round(shade)] * 3, 255)]])

    def test_compare_of_files_of_two_kinds_holds_their_values(self):
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
