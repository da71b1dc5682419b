#!/usr/bin/env python3
"""Every scene of ../shared/scenes (malformed ones aside, which malformed_test covers) is drawn without
a word of OpenGL, shows something, and has as many triangles as its index says; the city that examples/
makes of some of them stands together.

Usage: scenes_test.py PROGRAM [unittest arguments]
"""
import collections
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import png

PROGRAM = ""
SCENES = pathlib.Path(__file__).resolve().parents[3] / "shared" / "scenes"
EXTENSIONS = {".gltf", ".glb", ".obj", ".ac", ".acc", ".ply", ".dae", ".fbx", ".3ds"}

# As INDEX.md and the models' own files count them. Points and lines are none.
TRIANGLES = {
    "bevy_cornell_lightmap/CornellBox.glb": 36,
    "cornell_boxes/CornellBox-Empty-RG.obj": 12,
    "cornell_boxes/CornellBox-Glossy.obj": 1112,
    "cornell_boxes/CornellBox-Original.obj": 36,
    "crytek_sponza/gltf/sponza.gltf": 262267,
    "crytek_sponza/sponza.obj": 262267,
    "godot_living_room/living_room.glb": 5088,
    "godot_zdm2/zdm2.glb": 58772,
    "playcanvas_house/house.glb": 10497,
    "redeclipse_institute/institute.obj": 35376,
    "stanford_dragon/dragon_871k.glb": 871414,
    "stanford_dragon/dragon_vrip_res4.ply": 11102,
    "torcs_car1-trb1/car1-trb1.acc": 4351,
    "torcs_car1-trb1/car1-trb1.gltf": 4351,
    "torcs_street-1/street-1.acc": 25508,
    "torcs_street-1/street-1.gltf": 25508,
    "torcs_wheel-2/wheel-2.acc": 33317,
    "torcs_wheel-2/wheel-2.gltf": 33317,
    "gltf_features/PrimitiveMode_00/Mesh_PrimitiveMode_00.gltf": 0,
    "gltf_features/PrimitiveMode_01/Mesh_PrimitiveMode_01.gltf": 0,
    "gltf_features/PrimitiveMode_06/Mesh_PrimitiveMode_06.gltf": 2,
    "gltf_features/PrimitiveMode_07/Mesh_PrimitiveMode_07.gltf": 0,
    "gltf_features/emission_strength/14_emission_strength.gltf": 17280,
    "gltf_features/gpu_instancing/24_gpu_instancing.gltf": 7656770,  # with every instance
}
MODELS = {"phong", "metallic-roughness", "unlit", "specular-glossiness"}
KENNEY_TRIANGLES = 21336  # all 37 models together
CITY = pathlib.Path(__file__).resolve().parents[2] / "examples" / "city" / "city.json"
CITY_GROUND_TRIANGLES = 12


def scenes():
    return sorted(p for p in SCENES.rglob("*")
                  if p.suffix in EXTENSIONS and "malformed" not in p.relative_to(SCENES).parts)


def name_of(path):
    return path.relative_to(SCENES).as_posix()


def lucerna(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120, check=False)


@unittest.skipUnless(SCENES.is_dir(), f"no scenes at {SCENES}")
class ScenesTest(unittest.TestCase):
    def test_triangles_are_those_of_the_index(self):
        kenney = []
        for path in scenes():
            name = name_of(path)
            with self.subTest(name):
                run = lucerna("info", path, "--json")
                self.assertEqual(run.returncode, 0, run.stderr)
                said = json.loads(run.stdout)
                triangles = said["triangles"]
                self.assertLessEqual({material["model"] for material in said["material_list"]}, MODELS)
                if name.startswith("kenney_city_kit/"):
                    kenney.append(triangles)
                elif name in TRIANGLES:
                    self.assertEqual(triangles, TRIANGLES[name])
                else:  # INDEX.md gives a range for the feature models
                    self.assertTrue(2 <= triangles <= 17280, triangles)
        self.assertEqual(sum(kenney), KENNEY_TRIANGLES)

    def test_each_shows_something_without_a_word_of_opengl(self):
        with tempfile.TemporaryDirectory(prefix="lucerna-scenes-") as folder:
            for number, path in enumerate(scenes()):
                with self.subTest(name_of(path)):
                    picture = pathlib.Path(folder) / f"{number}.png"
                    run = lucerna("render", path, "-o", picture, "--size", "160x90", "--json")
                    self.assertEqual(run.returncode, 0, run.stderr)
                    self.assertEqual(json.loads(run.stdout)["gl_messages"], 0, run.stderr)
                    self.assertNotIn("OpenGL", run.stderr)
                    width, height, colors = png.read(picture.read_bytes())
                    self.assertEqual((width, height), (160, 90))
                    # The default background is one colour. Four lines cover 1.8 % of the picture.
                    (_, background), = collections.Counter(colors).most_common(1)
                    self.assertGreater(len(colors) - background, 0.015 * len(colors))

    def test_the_city_of_the_examples_stands_together(self):
        run = lucerna("info", CITY, "--json")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(json.loads(run.stdout)["triangles"], KENNEY_TRIANGLES + CITY_GROUND_TRIANGLES)
        with tempfile.TemporaryDirectory(prefix="lucerna-city-") as folder:
            picture = pathlib.Path(folder) / "city.png"
            run = lucerna("render", CITY, "-o", picture, "--size", "160x90", "--json")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(json.loads(run.stdout)["gl_messages"], 0, run.stderr)


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
