#!/usr/bin/env python3
"""An installation, moved, and what docs/dev/adding_a_pass.md does with it, command by command.

Usage: install_test.py SOURCE_DIR BINARY_DIR COMPILER [unittest arguments]
"""
import os
import pathlib
import shutil
import subprocess
import tempfile

import outside
from outside import BUILD, COMPILER, SOURCE, commands

# Nothing of this build may help.
ALONE = {"LUCERNA_WORKER": None, "LUCERNA_SHADERS": None, "LD_LIBRARY_PATH": None}


class InstallTest(outside.OutsideTest):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="lucerna-install-")
        cls.addClassCleanup(folder.cleanup)
        # As the page sees it: a checkout, its build, and out/ to write into.
        cls.checkout = pathlib.Path(folder.name).resolve() / "checkout"
        cls.out = cls.checkout / "out"
        cls.out.mkdir(parents=True)
        (cls.checkout / "examples").symlink_to(SOURCE / "examples")
        (cls.checkout / "build").mkdir()
        (cls.checkout / "build" / "release").symlink_to(BUILD)
        first = cls.out / "first"
        subprocess.run(["cmake", "--install", BUILD, "--prefix", first], check=True, stdout=subprocess.DEVNULL)
        cls.prefix = cls.out / "moved"
        shutil.move(first, cls.prefix)
        cls.lucerna = cls.prefix / "bin" / "lucerna"
        cls.packages = next(cls.prefix.rglob("pkgconfig"))

    def follow(self, section):
        self.succeed("bash", "-ec", commands(section), cwd=self.checkout, CXX=str(COMPILER), **ALONE)

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

    def test_every_header_compiles_with_glm_and_fmt_alone(self):
        flags = self.succeed("pkg-config", "--cflags", "lucerna", PKG_CONFIG_PATH=str(self.packages)).split()
        include = self.prefix / "include" / "lucerna"
        headers = sorted(path.relative_to(include) for path in include.rglob("*.hpp"))
        self.assertGreater(len(headers), 40)
        everything, standard = self.out / "everything.cpp", self.out / "standard.cpp"
        everything.write_text("".join(f'#include "{header}"\n' for header in headers))
        standard.write_text("#include <bits/stdc++.h>\n")  # all of C++ and what it takes of C
        compiler = [COMPILER, "-std=c++20", *flags]
        self.succeed(*compiler, "-Wall", "-Wextra", "-Werror", "-fsyntax-only", everything)

        def read(source):
            rule = self.succeed(*compiler, "-M", source).replace("\\\n", " ")
            return {pathlib.Path(name).resolve() for name in rule.partition(": ")[2].split()}
        self.assertTrue({include / header for header in headers} <= read(everything))
        beside = read(everything) - read(standard) - {everything}
        foreign = [str(path) for path in sorted(beside)
                   if not path.is_relative_to(include) and not {"glm", "fmt"} & set(path.parts)]
        self.assertEqual(foreign, [])

    def test_the_page_of_a_shader(self):
        self.follow("A shader")
        self.pictures("edges.png")

    def test_the_page_of_a_plugin_and_of_a_program(self):
        self.follow("A plugin")
        self.pictures("vignette.png", "again.png")
        self.assertEqual((self.out / "vignette.png").read_bytes(), (self.out / "again.png").read_bytes())
        self.follow("A program of your own")
        self.pictures("program.png", "by_hand.png")


if __name__ == "__main__":
    outside.main()
