#!/usr/bin/env python3
"""What scene files ask of the program as a whole: a decoder in a process of its own, a choice of
animations, a refusal that says what to do.

Usage: scene_files_test.py PROGRAM [unittest arguments]
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = ""
FILES = pathlib.Path(__file__).resolve().parents[1] / "fuzz" / "corpus" / "gltf"
ANIMATED = FILES / "animation.glb"


def lucerna(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120, check=False)


class SceneFilesTest(unittest.TestCase):
    def info(self, path):
        run = lucerna("info", path, "--json")
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads(run.stdout)

    def test_packed_meshes_are_unpacked(self):
        for name, triangles in (("draco.glb", 2), ("meshopt.glb", 4)):
            with self.subTest(name):
                scene = self.info(FILES / name)
                self.assertEqual(scene["triangles"], triangles)
                self.assertEqual(scene["bounds"], {"min": [0, 0, 0], "max": [1, 1, 0]})

    def test_an_animation_is_chosen_by_name_or_index(self):
        known = self.info(ANIMATED)["animation_list"]
        self.assertTrue(known[0]["playing"])
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder) / "a.png"
            for choice in ("0", known[0]["name"], "none"):
                run = lucerna("render", ANIMATED, "--animation", choice, "--size", "32x18", "-o", picture)
                self.assertEqual(run.returncode, 0, run.stderr)
            picture.unlink()
            run = lucerna("render", ANIMATED, "--animation", "fly", "--size", "32x18", "-o", picture)
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertIn("'fly' is not an animation of", run.stderr)
            self.assertIn(f"0 '{known[0]['name']}'", run.stderr)
            self.assertFalse(picture.exists())

    def test_ktx2_textures_are_refused_with_the_way_out(self):
        with tempfile.TemporaryDirectory() as folder:
            scene, picture = pathlib.Path(folder) / "a.gltf", pathlib.Path(folder) / "a.png"
            scene.write_text('{"asset": {"version": "2.0"}, "extensionsRequired": ["KHR_texture_basisu"]}')
            run = lucerna("render", scene, "-o", picture)
            self.assertEqual(run.returncode, 3, run.stderr)
            self.assertIn("KTX2 files, which are not decoded: export the file again with PNG or JPEG", run.stderr)
            self.assertFalse(picture.exists())


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
