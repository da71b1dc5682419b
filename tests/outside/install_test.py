#!/usr/bin/env python3
"""An installation, moved, and what docs/dev/adding_a_pass.md does with it, command by command.

Usage: install_test.py SOURCE_DIR BINARY_DIR COMPILER [unittest arguments]
"""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile

import outside
from outside import BUILD, COMPILER, SOURCE

PAGE = SOURCE / "docs" / "dev" / "adding_a_pass.md"
# Nothing of this build may help.
ALONE = {"LUCERNA_WORKER": None, "LUCERNA_SHADERS": None, "LD_LIBRARY_PATH": None}


INSTALL = "cmake --install build/release --prefix out/lucerna\n"


def commands(section):
    """Those of a section of the page."""
    text = re.search(rf"^## {section}\n(.*?)(?=^## |\Z)", PAGE.read_text(), re.S | re.M).group(1)
    return "".join(re.findall(r"^```sh\n(.*?)^```", text, re.S | re.M))


class InstallTest(outside.OutsideTest):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="lucerna-install-")
        cls.addClassCleanup(folder.cleanup)
        # As the page sees it: a checkout, its build, and out/ to write into.
        cls.checkout = pathlib.Path(folder.name) / "checkout"
        cls.out = cls.checkout / "out"
        cls.out.mkdir(parents=True)
        (cls.checkout / "examples").symlink_to(SOURCE / "examples")
        (cls.checkout / "build").mkdir()
        (cls.checkout / "build" / "release").symlink_to(BUILD)
        first = pathlib.Path(folder.name) / "first"
        subprocess.run(["cmake", "--install", BUILD, "--prefix", first], check=True, stdout=subprocess.DEVNULL)
        cls.prefix = cls.out / "lucerna"
        shutil.move(first, cls.prefix)
        cls.lucerna = cls.prefix / "bin" / "lucerna"
        cls.packages = next(cls.prefix.rglob("pkgconfig"))

    def follow(self, section):
        script = commands(section).replace(INSTALL, "")  # that is done, and moved since
        self.succeed("bash", "-ec", script, cwd=self.checkout, CXX=str(COMPILER), **ALONE)

    def pictures(self, *names):
        for name in names:
            self.assertTrue((self.out / name).read_bytes().startswith(b"\x89PNG"), name)

    def test_it_stands_alone(self):
        needed = subprocess.run(["ldd", self.lucerna], capture_output=True, text=True, check=True).stdout
        self.assertIn(f"{self.prefix}/", needed)
        self.assertNotIn(f"{BUILD}/", needed)
        # A script and another format's scene are read by the worker.
        scene = self.out / "triangle.obj"
        scene.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.succeed(self.lucerna, "render", scene, "--size", "32x18", "-o", self.out / "triangle.png", **ALONE)
        share = self.prefix / "share" / "lucerna"
        self.succeed(self.lucerna, "pipeline", "check", share / "pipelines" / "deferred.js", **ALONE)
        self.succeed(self.lucerna, "render", scene, "--size", "32x18", "--shaders", share / "shaders",
                     "-o", self.out / "again.png", **ALONE)
        self.assertEqual((self.out / "triangle.png").read_bytes(), (self.out / "again.png").read_bytes())

    def test_a_program_may_have_any_name(self):
        renamed = self.prefix / "bin" / "renamed"
        shutil.copy2(self.lucerna, renamed)
        self.addCleanup(os.remove, renamed)
        self.succeed(renamed, "pipeline", "check", "deferred", **ALONE)

    def test_every_header_compiles(self):
        flags = self.succeed("pkg-config", "--cflags", "lucerna", PKG_CONFIG_PATH=str(self.packages)).split()
        include = self.prefix / "include" / "lucerna"
        everything = self.out / "everything.cpp"
        headers = sorted(path.relative_to(include) for path in include.rglob("*.hpp"))
        self.assertGreater(len(headers), 40)
        everything.write_text("".join(f'#include "{header}"\n' for header in headers))
        self.succeed(COMPILER, "-std=c++20", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", *flags, everything)

    def test_the_page_of_a_shader(self):
        self.follow("A shader")
        self.pictures("edges.png")

    def test_the_page_of_a_plugin_and_of_a_program(self):
        self.assertIn(INSTALL, commands("A plugin"))
        self.follow("A plugin")
        self.pictures("vignette.png", "again.png")
        self.assertEqual((self.out / "vignette.png").read_bytes(), (self.out / "again.png").read_bytes())
        self.follow("A program of your own")
        self.pictures("program.png", "by_hand.png")


if __name__ == "__main__":
    outside.main()
