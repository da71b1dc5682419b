"""What the tests of this folder share: the three paths they are given, and running commands."""
import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE, BUILD, COMPILER = (pathlib.Path(word) for word in sys.argv[1:4])
LUCERNA = BUILD / "bin" / "lucerna"
EXAMPLE = SOURCE / "examples" / "vignette"
PAGE = SOURCE / "docs" / "dev" / "adding_a_pass.md"


def commands(section):
    """Those of a section of the page, as it gives them."""
    text = re.search(rf"^## {section}\n(.*?)(?=^## |\Z)", PAGE.read_text(), re.S | re.M).group(1)
    return "".join(re.findall(r"^```sh\n(.*?)^```", text, re.S | re.M))


class OutsideTest(unittest.TestCase):
    def run_command(self, *words, cwd=None, **environment):
        """With these environment variables, without those that are None."""
        variables = {name: value for name, value in {**os.environ, **environment}.items() if value is not None}
        return subprocess.run([str(word) for word in words], cwd=cwd, capture_output=True, text=True,
                              timeout=600, check=False, env=variables)

    def succeed(self, *words, cwd=None, **environment):
        run = self.run_command(*words, cwd=cwd, **environment)
        self.assertEqual(run.returncode, 0, f"{words}\n{run.stdout}\n{run.stderr}")
        return run.stdout

    def assert_whole_deferred_picture(self, program, pipeline, *options):
        """The pipeline has all rows of deferred.js, in its order."""
        def rows(name, *more):
            printed = self.succeed(program, "pipeline", "print", name, "--json", *more)
            return [row["type"] for row in json.loads(printed)["rows"]]
        found = iter(rows(pipeline, *options))
        for wanted in rows(SOURCE / "pipelines" / "deferred.js"):
            self.assertIn(wanted, found, f"{pipeline} lacks {wanted}, or has it too early")

    def assert_joins_in_tiles(self, folder, program, *options):
        """A picture of an even background, drawn in tiles, is the picture drawn at once."""
        scene, whole, tiled = (folder / name for name in ("even.json", "whole.png", "tiled.png"))
        scene.write_text('{"lucerna": "scene/1", "background": {"color": [0.5, 0.4, 0.3]}}')
        render = [program, "render", scene, "--size", "100x60", *options]
        self.succeed(*render, "-o", whole)
        self.succeed(*render, "--tile", "32", "-o", tiled)
        self.assertEqual(whole.read_bytes(), tiled.read_bytes())

    def fail_with(self, code, *wanted, command):
        """One message on stderr that holds every word."""
        run = self.run_command(*command)
        self.assertEqual(run.returncode, code, f"{command}\n{run.stderr}")
        self.assertEqual(run.stderr.count("error: "), 1, run.stderr)
        for word in wanted:
            self.assertIn(word, run.stderr)


def main():
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
