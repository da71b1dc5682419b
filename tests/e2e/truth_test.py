#!/usr/bin/env python3
"""The passes against the ray-traced reference, which shares no code with them.

Usage: truth_test.py PROGRAM [unittest arguments]
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = ""
# What is left is edges, where a ray and a rasteriser may see different surfaces, and the G-buffer's rounding.
LEAST_PSNR = 55  # dB
UNTEXTURED = ("builtin:cornell", "builtin:penumbra", "builtin:penumbra?case=panes", "builtin:penumbra?case=overlap")


def lucerna(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=300, check=False)


class TruthTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lucerna-truth-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_command(self, *arguments):
        run = lucerna(*arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def compare(self, truth, test):
        return json.loads(self.run_command("compare", truth, test, "--json"))

    def psnr(self, scene, pipeline, *reference):
        truth, test = self.folder / "truth.exr", self.folder / "test.exr"
        self.run_command("reference", scene, "--size", "320x180", *reference, "-o", truth)
        self.run_command("render", scene, "--size", "320x180", "--pipeline", pipeline, "-o", test)
        return self.compare(truth, test)["psnr"]

    def test_unshadowed_light_agrees(self):
        for scene in UNTEXTURED:
            for pipeline in ("deferred", "forward"):
                with self.subTest(scene=scene, pipeline=pipeline):
                    psnr = self.psnr(scene, pipeline, "--spp", 1, "--primary", "centre", "--shading", "point",
                                     "--shadows", "off", "--mirrors", 0)
                    print(f"{scene}, {pipeline}: {psnr:.1f} dB", flush=True)
                    self.assertGreater(psnr, LEAST_PSNR)

    def test_shadows_make_the_difference(self):
        psnr = self.psnr("builtin:penumbra", "deferred", "--spp", 1, "--primary", "centre", "--shading", "point")
        self.assertLess(psnr, LEAST_PSNR - 10)


    def test_hard_shadows(self):
        """Lights of no size: what is left is the stairs of the maps' texels along the shadows' edges."""
        scene, truth, test = (self.folder / name for name in ("hard.json", "truth.exr", "test.exr"))
        sun = {"lightSettings": {"lamp 1": {"on": False}},
               "lights": [{"name": "sun", "kind": "directional", "direction": [0.5, -1, -0.4], "intensity": 2}]}
        lamp = {"lightSettings": {"lamp 1": {"radius": 0}}}
        cases = [("builtin:cornell", {"lightSettings": {"lamp": {"radius": 0}}}, ["lispsm"])]
        for case in ("half-plane", "pole", "fence"):
            cases.append((f"builtin:penumbra?case={case}", lamp, ["lispsm"]))
            cases.append((f"builtin:penumbra?case={case}", sun, ["lispsm", "uniform", "cascades"]))
        for builtin, lights, methods in cases:
            scene.write_text(json.dumps({"lucerna": "scene/1", "include": [{"file": builtin}]} | lights))
            self.run_command("reference", scene, "--size", "320x180", "--spp", 1, "--primary", "centre", "-o", truth)

            def psnr(*sets):
                arguments = [word for value in sets for word in ("--set", value)]
                self.run_command("render", scene, "--size", "320x180", "--pipeline", "pcf", *arguments, "-o", test)
                return self.compare(truth, test)["psnr"]

            without = psnr("ShadowMaps.enabled=false")
            for method in methods:
                shadowed = psnr(f"ShadowMaps.method={method}", "ShadowMaps.localSize=2048")
                light = next(iter(lights.get("lights", [{"name": "its lamp"}])))["name"]
                print(f"{builtin}, {light}, {method}: {shadowed:.1f} dB, without shadows {without:.1f}", flush=True)
                with self.subTest(scene=builtin, light=light, method=method):
                    self.assertGreater(shadowed, 40)
                    self.assertGreater(shadowed, without + 10)

    def test_mirrors(self):
        # Pictures without detail: the reference reads textures in their finest level.
        scene = self.folder / "mirrors.json"
        plain = {"albedoTexture": {"scale": [0, 0]}}
        scene.write_text(json.dumps({
            "lucerna": "scene/1", "include": [{"file": "builtin:mirrors"}],
            "materials": {"wallpaper": plain, "parquet": plain,
                          "clock": plain | {"emissiveTexture": {"scale": [0, 0]}}}}))
        truth, test = self.folder / "truth.exr", self.folder / "test.exr"
        for camera in ("main", "between"):
            self.run_command("reference", scene, "--size", "320x180", "--camera", camera, "--spp", 1, "--primary",
                             "centre", "--shading", "point", "--shadows", "off", "--mirrors", 4, "-o", truth)
            for arguments, reflects in ((("forward",), True), (("deferred",), True),
                                        (("forward", "--set", "Mirrors.depth=1"), False),
                                        (("forward", "--set", "Mirrors.enabled=false"), False)):
                with self.subTest(camera=camera, arguments=arguments):
                    self.run_command("render", scene, "--size", "320x180", "--camera", camera, "--pipeline",
                                     *arguments, "-o", test)
                    psnr = self.compare(truth, test)["psnr"]
                    print(f"builtin:mirrors without pictures, {camera}, {' '.join(arguments)}: {psnr:.1f} dB",
                          flush=True)
                    # As above, and more edges: those of each reflection.
                    (self.assertGreater if reflects else self.assertLess)(psnr, LEAST_PSNR - 5)

    def test_depth_of_field(self):
        """Both methods against a thin lens; shadows and mirrors are left out of all pictures."""
        for scene, focus, radius in (("builtin:penumbra", 6, 0.3), ("builtin:atrium", 12, 0.4)):
            truth, test = self.folder / "truth.exr", self.folder / "test.exr"
            self.run_command("reference", scene, "--size", "320x180", "--spp", 64, "--primary", "centre", "--shading",
                             "point", "--shadows", "off", "--mirrors", 0, "--lens-radius", radius,
                             "--focus-distance", focus, "-o", truth)
            flip = {}
            for method in ("enabled=false", "method=separable", "method=gather"):
                self.run_command("render", scene, "--size", "320x180", "--pipeline", "depth_of_field",
                                 "--set", f"DepthOfField.{method}", "--set", f"DepthOfField.lensRadius={radius}",
                                 "--set", f"DepthOfField.focusDistance={focus}", "--set", "Mirrors.enabled=false",
                                 "-o", test)
                compared = self.compare(truth, test)
                flip[method] = compared["flip"]["mean"]
                print(f"{scene}, {method}: FLIP {flip[method]:.3f}, {compared['psnr']:.1f} dB", flush=True)
            with self.subTest(scene):
                self.assertLess(flip["method=gather"], 0.5 * flip["enabled=false"])
                self.assertLess(flip["method=gather"], 0.9 * flip["method=separable"])

    def test_ambient_occlusion(self):
        for scene, radius in (("builtin:cornell?ambient=1", 0.3), ("builtin:atrium", 1)):
            truth = self.folder / "ao.exr"
            self.run_command("reference", scene, "--size", "320x180", "--primary", "centre", "--spp", 64,
                             "--ao-radius", radius, "--layers", "ao", "-o", truth)
            error = {}
            for method in ("horizon", "hemisphere", "gaussian"):
                test = self.folder / f"{method}.exr"
                pipeline = self.folder / "ao.js"
                pipeline.write_text(f"""pipeline({{output: "TiledLighting.color"}});
                    pass("Cull"); pass("GBuffer");
                    pass("ScreenSpaceAo", {{method: "{method}", radius: {radius}, samples: 24}});
                    pass("SaveImage", {{file: {json.dumps(str(test))},
                                        reads: {{color: "ScreenSpaceAo.ambientVisibility"}}}});
                    pass("TiledLighting");""")
                self.run_command("render", scene, "--size", "320x180", "--pipeline", pipeline, "-o",
                                 self.folder / "picture.exr")
                error[method] = self.compare(truth, test)["rmse"] ** 2
            print(f"{scene}: mean squared error {error}", flush=True)
            with self.subTest(scene):
                self.assertLess(error["horizon"], 0.7 * error["hemisphere"])
                self.assertLess(error["horizon"], 0.01)


class CommandTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lucerna-reference-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_says_what_it_made(self):
        picture = self.folder / "out.exr"
        run = lucerna("reference", "builtin:cornell", "--size", "32x18", "--spp", 64, "--error", 0.2, "--ao-radius", 0.3,
                      "--layers", "color,direct,reflection,ao,visibility,error", "-o", picture, "--json")
        self.assertEqual(run.returncode, 0, run.stderr)
        said = json.loads(run.stdout)
        self.assertEqual(said["files"], [str(picture)])
        self.assertTrue(16 <= said["samples"] < 64, said["samples"])
        self.assertTrue(0 <= said["error"]["median"] < said["error"]["p99"])  # half of it is black
        self.assertEqual(len(said["lights"]), 1)
        again = self.folder / "again.exr"
        lucerna("reference", "builtin:cornell", "--size", "32x18", "--spp", 64, "--error", 0.2, "--ao-radius", 0.3, "--layers",
                "color,direct,reflection,ao,visibility,error", "--threads", 1, "-o", again)
        self.assertEqual(picture.read_bytes(), again.read_bytes())

    def test_refuses_what_cannot_be(self):
        for arguments, code, words in (
                (("builtin:cornell", "-o", self.folder / "a.png"), 2, ".exr or .hdr"),
                (("builtin:cornell", "-o", self.folder / "a.hdr", "--layers", "color,error"), 2, "several layers"),
                (("builtin:cornell", "-o", self.folder / "a.exr", "--layers", "color,ao"), 2, "--ao-radius"),
                (("builtin:cornell", "-o", self.folder / "a.exr", "--layers", "colour"), 2, "did you mean"),
                (("builtin:cornell", "-o", self.folder / "a.exr", "--focus-distance", 2), 2, "--lens-radius"),
                (("builtin:cornell", "-o", self.folder / "no" / "a.exr"), 2, "folder"),
                (("builtin:cornel", "-o", self.folder / "a.exr"), 3, "cornell"),
                (("builtin:cornell", "-o", self.folder / "a.exr", "--camera", "none"), 2, "camera")):
            with self.subTest(arguments):
                run = lucerna("reference", *arguments)
                self.assertEqual(run.returncode, code, run.stderr)
                self.assertIn(words, run.stderr)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
