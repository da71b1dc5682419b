#!/usr/bin/env python3
"""--plugin: the example beside this build, and libraries that are none.

Usage: plugin_test.py SOURCE_DIR BINARY_DIR COMPILER [unittest arguments]
"""
import pathlib
import tempfile

import outside
from outside import BUILD, COMPILER, EXAMPLE, LUCERNA

VIGNETTE = next(BUILD.glob("lib*/**/vignette.so"))
RENDER = [LUCERNA, "render", "builtin:atrium?lights=2", "--size", "64x36"]


class PluginTest(outside.OutsideTest):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lucerna-plugin-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def library(self, code):
        """A shared library of this C++ text."""
        made = self.folder / "made.so"
        (self.folder / "made.cpp").write_text(code)
        self.succeed(COMPILER, "-shared", "-fPIC", self.folder / "made.cpp", "-o", made)
        return made

    def refused(self, plugin, code, *wanted):
        picture = self.folder / "a.png"
        self.fail_with(code, *wanted, command=[*RENDER, "--plugin", plugin, "-o", picture])
        self.fail_with(code, *wanted, command=[LUCERNA, "pass", "list", "--plugin", plugin])
        self.assertFalse(picture.exists())

    def test_every_command_that_names_passes_knows_it(self):
        with_plugin = ["--plugin", VIGNETTE]
        pipeline = EXAMPLE / "vignette.js"
        self.assertIn("Vignette", self.succeed(LUCERNA, "pass", "list", *with_plugin))
        self.assertNotIn("Vignette", self.succeed(LUCERNA, "pass", "list"))
        self.assertIn("strength", self.succeed(LUCERNA, "pass", "show", "Vignette", *with_plugin))
        self.assertIn("valid", self.succeed(LUCERNA, "pipeline", "check", pipeline, *with_plugin))
        self.fail_with(5, "Vignette", "--plugin", command=[LUCERNA, "pipeline", "check", pipeline])

    def test_it_draws(self):
        pictures = {name: self.folder / f"{name}.png" for name in ("without", "zero", "dark")}
        row = ["--plugin", VIGNETTE, "--pipeline", EXAMPLE / "vignette.js"]
        self.succeed(*RENDER, "-o", pictures["without"])
        self.succeed(*RENDER, *row, "--set", "Vignette.strength=0", "-o", pictures["zero"])
        self.succeed(*RENDER, *row, "-o", pictures["dark"])
        self.assertEqual(pictures["without"].read_bytes(), pictures["zero"].read_bytes())
        self.succeed(LUCERNA, "compare", pictures["without"], pictures["zero"], "--fail-above", "0")
        self.fail_with(1, "differs", command=[LUCERNA, "compare", pictures["without"], pictures["dark"],
                                              "--fail-above", "0.05"])

    def test_it_joins_in_tiles(self):
        self.assert_joins_in_tiles(self.folder, LUCERNA, "--plugin", VIGNETTE, "--pipeline", EXAMPLE / "vignette.js")

    def test_examples_draw_all_that_the_deferred_picture_holds(self):
        examples = sorted(EXAMPLE.parent.glob("*/*.js"))
        self.assertGreaterEqual(len(examples), 3)
        for pipeline in examples:
            self.assert_whole_deferred_picture(LUCERNA, pipeline, "--plugin", VIGNETTE)

    def test_what_is_no_library_is_refused(self):
        self.refused(self.folder / "missing.so", 3, "missing.so", "No such file")
        self.refused(self.folder, 3, "wanted a plugin")
        text = self.folder / "text.so"
        text.write_text("this is no library")
        self.refused(text, 5, "text.so", "cannot be loaded", "adding_a_pass.md")

    def test_a_library_without_an_entry_point_is_refused(self):
        self.refused(self.library("int f() { return 1; }"), 5, "is no plugin", "'lucernaPluginBuilt'")

    def test_another_version_is_refused_before_it_runs(self):
        self.refused(self.library("""
            #include <cstdlib>
            extern "C" const char* lucernaPluginBuilt() { return "0.0.9-0123456789ab"; }
            extern "C" void lucernaPlugin(void*) { std::abort(); }"""), 5, "0.0.9-0123456789ab", "build the plugin again")

    def test_what_needs_more_than_there_is_is_refused(self):
        self.refused(self.library("""
            namespace lucerna { void ofTheFuture(); }
            void (*needed)() = lucerna::ofTheFuture;"""), 5, "undefined symbol", "ofTheFuture")

    def test_names_that_are_taken_are_refused(self):
        self.fail_with(5, "brings a pass 'Vignette'", "already",
                       command=[LUCERNA, "pass", "list", "--plugin", VIGNETTE, "--plugin", VIGNETTE])


if __name__ == "__main__":
    outside.main()
