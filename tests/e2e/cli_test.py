#!/usr/bin/env python3
"""The command line from outside: exit codes, messages, JSON, and that no partial file stays behind.

Usage: cli_test.py PROGRAM [unittest arguments]
"""
import csv
import json
import os
import pathlib
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = ""
SMALL = ["--size", "64x36"]
ATRIUM = "builtin:atrium?lights=2"


def png_size(path):
    return struct.unpack(">II", pathlib.Path(path).read_bytes()[16:24])


def mp4_frames(path):
    """The number of pictures in an MP4 file, from its table of sample sizes."""
    data = pathlib.Path(path).read_bytes()
    at = data.index(b"stsz")
    return struct.unpack(">I", data[at + 12:at + 16])[0]


class CliTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lucerna-cli-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def lucerna(self, *arguments, environment=None):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120,
                              cwd=self.folder, env={**os.environ, **(environment or {})}, check=False)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def assert_ok(self, run):
        self.assertEqual(run.returncode, 0, run.stderr)

    def assert_fails(self, code, *words, arguments, environment=None):
        """Runs, and expects the exit code, every word on stderr, nothing on stdout, and no new file."""
        before = sorted(self.folder.iterdir())
        run = self.lucerna(*arguments, environment=environment)
        self.assertEqual(run.returncode, code, f"{arguments}\n{run.stderr}")
        for word in words:
            self.assertIn(word, run.stderr)
        self.assertEqual(run.stdout, "")
        self.assertEqual(sorted(self.folder.iterdir()), before, "a file was left behind")
        return run

    # Usage: exit 2

    def test_unknown_words_are_answered_with_what_was_meant(self):
        self.assert_fails(2, "'rendr'", "did you mean 'render'", arguments=["rendr"])
        self.assert_fails(2, "'--sise'", "did you mean '--size'", arguments=["render", ATRIUM, "--sise=3", "-o", "a.png"])
        self.assert_fails(2, "'lst'", "did you mean 'list'", arguments=["pass", "lst"])
        self.assert_fails(2, "'--ouput'", "did you mean '--output'", arguments=["render", ATRIUM, "--ouput", "a.png"])
        self.assert_fails(2, "'extra'", arguments=["info", ATRIUM, "extra"])
        self.assert_fails(2, "'GBufer'", "did you mean 'GBuffer'", arguments=["pass", "show", "GBufer"])
        self.assert_fails(2, "did you mean 'deferred'", arguments=["pipeline", "check", "defered"])

    def test_bad_values_say_what_is_wanted(self):
        def fails(*words, flags):
            self.assert_fails(2, *words, arguments=["render", ATRIUM, "-o", "a.png", *flags])
        fails("--size", "1280x720", flags=["--size", "big"])
        fails("--scale", "25 to 400", flags=["--scale", "10"])
        fails("--frames", "'0'", flags=["--frames", "0"])
        fails("--gl", "without a window", flags=["--gl", "window"])
        fails("--gl", "did you mean 'egl'", flags=["--gl", "elg"])
        fails("--exposure", "'bright'", flags=["--exposure", "bright"])
        fails("--set", "wanted a value", flags=["--set"])
        fails("--scale", "'50.5'", "whole number from 25 to 400", flags=["--scale", "50.5"])
        fails("--seed", "'-1'", "whole number from 0", flags=["--seed", "-1"])
        fails("--threads", "0 to 1024", flags=["--threads", "many"])
        fails("--time-step", "'nan'", flags=["--time-step", "nan"])
        fails("--exr-type", "half or float", flags=["--exr-type", "double"])
        fails("--exr-type", "'a.png' is no EXR file; give -o NAME.exr", flags=["--exr-type", "float"])
        fails("--camera excludes --camera-path", flags=["--camera", "0", "--camera-path", "p.json"])
        fails("--output", "more than one", flags=["-o", "b.png"])
        fails("ToneMap.exposure", "-20 to 20", flags=["--set", "ToneMap.exposure=99"])
        fails("--pipeline", "wanted a value", flags=["--pipeline"])
        fails("--profile", "does not exist", flags=["--profile", "nowhere/p.csv"])
        fails("frame-%04d.png", flags=["--frames", "2"])
        fails("--profile", ".csv, .json, .md or .html", flags=["--profile", "p.txt"])
        fails("--layers", ".exr", flags=["--layers", "depth"])
        fails("--shaders", flags=["--shaders", "nowhere"])
        fails("ToneMap", "exposure", flags=["--set", "ToneMap.exposur=1"])
        fails("'script.x'", flags=["--pipeline", self.write("p.json", '{"lucerna": "pipeline/1", "passes": []}'),
                                   "--set", "script.x=1"])
        fails("--fps", ".mp4", flags=["--fps", "25"])
        fails("--crf", "0 to 51", flags=["--crf", "60"])
        fails("--lights-off", "--lightmap", flags=["--lights-off", "lamps"])
        self.assert_fails(2, ".png, .exr, .hdr, .mp4, .mkv", arguments=["render", ATRIUM, "-o", "a.avi"])
        self.assert_fails(2, "one file", arguments=["render", ATRIUM, "-o", "a-%d.mp4"])
        self.assert_fails(2, ".mkv", arguments=["render", ATRIUM, "-o", "a.mp4", "--lossless"])
        self.assert_fails(2, "even sides", "642x362",
                          arguments=["render", ATRIUM, "-o", "a.mp4", "--size", "641x361"])
        self.assert_fails(2, "--fps", arguments=["render", ATRIUM, "-o", "a.mp4", "--time-step", "0"])
        self.assert_fails(2, "does not exist", arguments=["render", ATRIUM, "-o", "nowhere/a.png"])
        self.assert_fails(2, "--output is required", arguments=["render", ATRIUM])
        self.assert_fails(2, "'5'", "not a camera", arguments=["render", ATRIUM, "-o", "a.png", "--camera", "5"])

    def test_groups_that_are_off_may_have_spaces_around(self):
        self.write("floor.obj", "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3 4\n")
        lamp = {"kind": "point", "intensity": 9, "position": [0, 1, 0]}
        self.write("lamps.json", json.dumps({"lucerna": "scene/1", "include": [{"file": "floor.obj"}],
                                             "lights": [lamp, {**lamp, "group": "desk"}, {**lamp, "group": "shop"}]}))
        self.assert_ok(self.lucerna("bake", "lamps.json", "-o", "b", "--size", "64", "--lights", "desk, shop ,always-on"))
        render = ["render", "lamps.json", "--lightmap", "b", *SMALL]
        for name, groups in (("a.png", "desk,shop"), ("b.png", "desk, shop "), ("c.png", "desk")):
            self.assert_ok(self.lucerna(*render, "-o", name, "--lights-off", groups))
        a, b, c = ((self.folder / name).read_bytes() for name in ("a.png", "b.png", "c.png"))
        self.assertEqual(a, b)
        self.assertNotEqual(a, c)
        self.assert_fails(2, "always on cannot be switched off", "wanted one of desk, shop",
                          arguments=[*render, "-o", "d.png", "--lights-off", "always-on"])

    def test_objects_that_moved_since_the_bake_are_warned_of(self):
        self.write("floor.obj", "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3 4\n")
        lamp = {"kind": "point", "intensity": 9, "position": [0, 3, 0]}

        def warnings(height, *flags):
            self.write("two.json", json.dumps({"lucerna": "scene/1", "lights": [lamp], "include": [
                {"file": "floor.obj"}, {"file": "floor.obj", "translation": [0, height, 0]}]}))
            if "-o" in flags:
                self.assert_ok(self.lucerna("bake", "two.json", *flags))
            run = self.lucerna("render", "two.json", "--lightmap", "b", *SMALL, "-o", "a.png")
            self.assert_ok(run)
            return run.stderr
        self.assertNotIn("warning", warnings(1, "-o", "b", "--size", "64"))
        self.assertIn("1 of the 2 objects of the lightmap have been moved, turned or scaled", warnings(1.5))

    def test_objects_that_an_animation_moves_are_not_warned_of(self):
        moving = "builtin:atrium?moving=0.5"
        self.assert_ok(self.lucerna("bake", moving, "-o", "b", "--density", 1, "--preset", "preview", "--size", "512"))
        for flags in (["--time", 2.5], ["--animation", "none"]):
            run = self.lucerna("render", moving, "--lightmap", "b", *SMALL, *flags, "-o", "a.png")
            self.assert_ok(run)
            self.assertNotIn("warning", run.stderr)

    def test_bad_values_of_other_subcommands(self):
        def fails(*words, arguments):
            self.assert_fails(2, *words, arguments=arguments)
        for value in ("2", "nan", "little"):
            fails("--fail-above", f"'{value}'", "0 to 1", arguments=["compare", "a.png", "b.png", "--fail-above", value])
        fails("--pixels-per-degree", "1 to 1000",
              arguments=["compare", "a.png", "b.png", "--pixels-per-degree", "0"])
        fails("--hdr excludes --ldr", arguments=["compare", "a.png", "b.png", "--hdr", "--ldr"])
        fails("--heatmap", "does not exist", arguments=["compare", "a.png", "b.png", "--heatmap", "nowhere/e.png"])
        fails("TEST is required", arguments=["compare", "a.png"])
        fails("SCENE is required", arguments=["info"])
        fails("'--caps'", arguments=["doctor", "--caps"])
        fails("--output is required", arguments=["pipeline", "graph", "deferred"])
        fails("-o", ".svg or .dot", arguments=["pipeline", "graph", "deferred", "-o", "a.txt"])
        fails("-o", "does not exist", arguments=["pipeline", "graph", "deferred", "-o", "nowhere/a.svg"])
        fails("--size", "1280x720", arguments=["pipeline", "print", "deferred", "--size", "3"])

    def test_no_words_print_the_help(self):
        self.assert_fails(2, "render", "compare", arguments=[])
        self.assert_fails(2, "Usage: lucerna pass", "list", "show", arguments=["pass"])

    # Input: exit 3

    def test_a_folder_without_a_lightmap_is_named_in_one_line(self):
        run = self.assert_fails(3, "'nowhere' holds no lightmap", "lucerna bake",
                                arguments=["render", "builtin:cornell", "--lightmap", "nowhere", "-o", "a.png", *SMALL])
        self.assertEqual(run.stderr.count("\n"), 1)

    def test_unreadable_input(self):
        bad = self.write("bad.gltf", "{")
        missing = self.folder / "missing.gltf"
        self.assert_fails(3, "bad.gltf", arguments=["render", bad, "-o", "a.png"])
        self.assert_fails(3, "missing.gltf", arguments=["render", missing, "-o", "a.png"])
        self.assert_fails(3, "missing.gltf", arguments=["info", missing])
        self.assert_fails(3, "missing.json", arguments=["render", ATRIUM, "-o", "a.png", "--camera", "missing.json"])
        path = self.write("path.json", '{"lucerna": "camera-path/1", "keyframes": []}')
        self.assert_fails(3, "path.json", "keyframe", arguments=["render", ATRIUM, "-o", "a.png", "--camera-path", path])
        self.assert_fails(3, "nothing.png", arguments=["compare", "nothing.png", "nothing.png"])

    # Pipelines, scripts, shaders: exit 5

    def test_faulty_pipelines(self):
        script = self.write("p.js", "pass('Cull');\npass('GBufer');\npass('TiledLighting', {reads: {depth: 'Nobody.depth'}});\n")
        run = self.assert_fails(5, "p.js:2", "did you mean 'GBuffer'", "p.js:3", "Nobody",
                                arguments=["pipeline", "check", script])
        self.assert_fails(5, "p.js:2", arguments=["render", ATRIUM, "-o", "a.png", "--pipeline", script])
        self.assertNotIn("terminate", run.stderr)
        self.assert_fails(5, "s.js:2: SyntaxError",
                          arguments=["pipeline", "print", self.write("s.js", "pass('Cull'\n;")])
        self.assert_fails(5, "p.json:1: /passes/0/typ", "did you mean 'type'", "p.json:1, pass 'GBufer'", "did you mean 'GBuffer'",
                          arguments=["pipeline", "check", self.write("p.json", '{"lucerna": "pipeline/1", "passes": ['
                                                                    '{"typ": "Cull"}, {"type": "GBufer"}]}')])
        self.assert_fails(5, "p.json:1:", "the number 1e999", arguments=["pipeline", "check", self.write(
            "p.json", '{"lucerna": "pipeline/1", "passes": [{"type": "Cull", "params": {"x": 1e999}}]}')])

    def test_a_script_without_end_is_stopped(self):
        start = time.monotonic()
        self.assert_fails(5, "loop.js", "5 s", arguments=["pipeline", "check", self.write("loop.js", "for (;;) {}")])
        self.assertLess(time.monotonic() - start, 8)

    def test_a_shader_that_does_not_compile(self):
        folder = self.folder / "shaders" / "passes" / "tone_map"
        folder.mkdir(parents=True)
        (folder / "tone_map.frag").write_text("void main() {\n  nonsense;\n}\n")
        self.assert_fails(5, "passes/tone_map/tone_map.frag:2", "nonsense",
                          arguments=["render", ATRIUM, *SMALL, "-o", "a.png", "--shaders", "shaders"])

    def test_faults_of_a_fullscreen_row_and_its_shader(self):
        (self.folder / "sub").mkdir()
        self.write("sub/own.glsl", "float half_() { return 0.5; }\n")
        self.write("sub/a.frag", '#include "own.glsl"\nuniform float level = 1.0;  // 0 to 1: x\n'
                   "uniform sampler2D color;\nlayout(location = 0) out vec4 made;\nvoid main() { made = vec4(level); }\n")
        self.write("broken.frag", "void main() {\n  nonsense;\n}\n")
        rows = 'pass("Cull"); pass("Forward"); pass("Fullscreen", {%s});'
        good = self.write("sub/p.js", rows % 'shader: "a.frag", params: {level: 0.5}')
        self.assert_ok(self.lucerna("pipeline", "check", "sub/p.js"))
        self.assert_ok(self.lucerna("render", ATRIUM, *SMALL, "--pipeline", good, "-o", "a.png"))
        for arguments, *words in (
                (["--set", "Fullscreen.levl=1"], "did you mean 'level'"),
                (["--set", "Fullscreen.level=2"], "from 0 to 1"),
                (["--set", "Fullscreen.reads.colr=Forward.color"], "did you mean 'color'")):
            self.assert_fails(2, *words, arguments=["pipeline", "check", "sub/p.js", *arguments])
        for text, *words in (
                ('shader: "nowhere.frag"', "./sub/nowhere.frag: cannot be opened", "relative to the pipeline's file"),
                ('shader: "a.frag", level: "much"', "WrongValueType", "'level'"),
                ('shader: "a.frag", reads: {colr: "Forward.color"}', "did you mean 'color'")):
            self.assert_fails(5, "p2.js:1", *words, arguments=[
                "pipeline", "check", self.write("sub/p2.js", rows % text).relative_to(self.folder)])
        # On the command line files are relative to the working directory.
        self.write("sub/p2.js", rows % "")
        self.assert_fails(5, "./broken.frag:2", "nonsense", arguments=[
            "render", ATRIUM, *SMALL, "--pipeline", "sub/p2.js", "--set", "Fullscreen.shader=broken.frag", "-o", "b.png"])
        show = self.lucerna("pass", "show", "Fullscreen", "--set", "shader=sub/a.frag", "--json")
        self.assert_ok(show)
        self.assertIn("level", [param["name"] for param in json.loads(show.stdout)["params"]])

    def test_materials_with_shaders_of_their_own(self):
        self.write("tri.obj", "mtllib tri.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n")
        self.write("tri.mtl", "newmtl paint\nKd 0.5 0.5 0.5\n")
        self.write("tri.lucerna.json", json.dumps({"lucerna": "scene/1", "materials": {"paint": {
            "shader": {"file": "glow.frag", "parameters": {"tint": [1, 0, 0]}}}}}))
        render = ["render", "tri.obj", *SMALL, "-o", "a.png"]
        self.assert_fails(3, "tri.lucerna.json:1", "glow.frag, which is no file", "custom_shader.glsl", arguments=render)
        shader = '#include "render/custom_shader.glsl"\nuniform vec3 tint;\nvec3 radianceOf(Surface s) {\n'
        self.write("glow.frag", shader + "  return tint.nothing;\n}\n")
        self.assert_fails(5, "glow.frag:4: error", "nothing", arguments=render)
        self.write("glow.frag", shader.replace("vec3 tint", "vec4 tint") + "  return tint.rgb;\n}\n")
        self.assert_fails(5, "glow.frag", "'tint' is vec3", "vec4", arguments=render)
        self.write("glow.frag", shader + "  return tint * s.normalW.z;\n}\n")
        for pipeline in "deferred", "forward":
            self.assert_ok(self.lucerna(*render, "--pipeline", pipeline))

    def test_a_driver_that_lacks_a_feature(self):
        caps = self.write("caps.json", '{"name": "poor", "features": [], "renderable": ["Rgba8Unorm"]}')
        run = self.lucerna("pipeline", "check", "deferred", "--caps", caps, "--json")
        self.assertEqual(run.returncode, 5)
        faults = json.loads(run.stdout)["faults"]
        self.assertIn("UnsupportedFormat", {fault["kind"] for fault in faults})

    def test_what_doctor_prints_is_what_caps_reads(self):
        run = self.lucerna("doctor", "--json")
        self.assert_ok(run)
        caps = self.write("driver.json", run.stdout)
        self.assert_ok(self.lucerna("pipeline", "check", "deferred", "--caps", caps))
        only = self.write("gl.json", json.dumps(json.loads(run.stdout)["gl"]))
        self.assert_ok(self.lucerna("pipeline", "check", "deferred", "--caps", only))
        self.assert_fails(3, "caps.json:1: /maxTextures", "did you mean 'maxTextureSide'",
                          arguments=["pipeline", "check", "deferred", "--caps",
                                     self.write("caps.json", '{"features": [], "renderable": [], "maxTextures": 1}')])

    def test_without_a_driver(self):
        self.assert_fails(4, "OpenGL", "apt-get install", arguments=["doctor"],
                          environment={"__EGL_VENDOR_LIBRARY_FILENAMES": "/nowhere.json"})

    # What works

    def test_render_writes_pictures_and_one_json_document(self):
        run = self.lucerna("render", ATRIUM, *SMALL, "--frames", 2, "--time-step", "0.5", "-o", "f-%02d.png",
                           "--profile", "p.csv", "--json")
        self.assert_ok(run)
        document = json.loads(run.stdout)
        self.assertEqual(document["files"], ["f-00.png", "f-01.png"])
        self.assertEqual(document["gl_messages"], 0)
        self.assertEqual(png_size(self.folder / "f-01.png"), (64, 36))
        self.assertEqual(len(self.read_profile("p.csv")), 2)

    def test_warnings_of_the_pipeline_are_in_the_document(self):
        run = self.lucerna("render", ATRIUM, *SMALL, "--set", "Background.enabled=false",
                           "--set", "Mirrors.reads.color=CustomShaders.color", "-o", "a.png", "--json")
        self.assert_ok(run)
        self.assertEqual(json.loads(run.stdout)["warnings"], [])
        (self.folder / "idle.json").write_text(json.dumps({"lucerna": "pipeline/1", "passes": [
            {"type": t} for t in ("Cull", "GBuffer", "Forward", "ToneMap")]}))
        run = self.lucerna("render", ATRIUM, *SMALL, "--pipeline", "idle.json", "-o", "a.png", "--json")
        self.assert_ok(run)
        warnings = json.loads(run.stdout)["warnings"]
        self.assertTrue(any("GBuffer" in warning for warning in warnings), warnings)

    def check_costs(self, frames):
        """frames: of each its passes and then itself, as rows of numbers."""
        for *passes, frame in frames:
            self.assertLessEqual({"Cull", "GBuffer", "TiledLighting", "ToneMap"}, {row["pass"] for row in passes})
            for key in ("cpu_ms", "gpu_ms", "draws", "primitives"):
                self.assertAlmostEqual(frame[key], sum(row[key] for row in passes), delta=0.001, msg=key)
            by_name = {row["pass"]: row for row in passes}
            self.assertGreater(by_name["GBuffer"]["primitives"], 100)
            self.assertGreater(by_name["GBuffer"]["draws"], 1)
            self.assertGreater(by_name["GBuffer"]["gpu_ms"], 0)
            self.assertGreater(by_name["Cull"]["cpu_ms"], 0)
            self.assertEqual(by_name["ToneMap"]["texture_bytes"], 64 * 36 * 4)
            self.assertGreater(frame["texture_bytes"], by_name["GBuffer"]["texture_bytes"])
            self.assertLess(frame["texture_bytes"], sum(row["texture_bytes"] for row in passes))

    def read_profile(self, name):
        """The rows of each frame of a CSV."""
        with open(self.folder / name, newline="") as file:
            reader = csv.DictReader(file)
            rows = [{key: value if key in ("pass", "view", "gpu_clock") else float(value) for key, value in row.items()}
                    for row in reader]
            self.assertEqual(reader.fieldnames, ["frame", "pass", "view", "cpu_ms", "gpu_ms", "draws", "primitives",
                                                 "texture_bytes", "gpu_clock"])
        frames = {}
        for row in rows:
            frames.setdefault(row["frame"], []).append(row)
        for row in (frame[-1] for frame in frames.values()):
            self.assertEqual((row["pass"], row["view"]), ("(frame)", ""))
        return list(frames.values())

    def test_profiles_have_the_costs_of_passes_and_frames(self):
        for name in ("p.csv", "p.json"):
            self.assert_ok(self.lucerna("render", ATRIUM, *SMALL, "--frames", 2, "-o", "f-%d.png", "--profile", name))
        frames = self.read_profile("p.csv")
        self.assertEqual(len(frames), 2)
        self.check_costs(frames)
        document = json.loads((self.folder / "p.json").read_text())
        self.assertEqual(document["lucerna"], "profile/1")
        self.assertEqual([frame["frame"] for frame in document["frames"]], [0, 1])
        self.assertEqual(document["gpu_clock"], frames[0][0]["gpu_clock"])
        self.check_costs([[*frame["passes"], frame] for frame in document["frames"]])

    def test_render_to_exr_hdr_and_profile_as_json(self):
        for name, flags in (("a.exr", ["--layers", "color,depth,normal,albedo", "--exr-type", "float"]), ("a.hdr", [])):
            self.assert_ok(self.lucerna("render", ATRIUM, *SMALL, *flags, "-o", name, "--profile", "p.json"))
            self.assertGreater((self.folder / name).stat().st_size, 1000)
            self.assertEqual(json.loads((self.folder / "p.json").read_text())["lucerna"], "profile/1")

    def test_video(self):
        flags = [*SMALL, "--frames", 12, "--time-step", "0.04"]
        for name, more in (("a.mp4", []), ("b.mp4", []), ("c.mkv", ["--lossless"]), ("d.mp4", ["--crf", 40, "--fps", 5])):
            run = self.lucerna("render", ATRIUM, *flags, *more, "-o", name, "--json")
            self.assert_ok(run)
            self.assertEqual(json.loads(run.stdout)["files"], [name])
        self.assertEqual((self.folder / "a.mp4").read_bytes(), (self.folder / "b.mp4").read_bytes())
        self.assertEqual(mp4_frames(self.folder / "a.mp4"), 12)
        self.assertLess((self.folder / "d.mp4").stat().st_size, (self.folder / "a.mp4").stat().st_size)
        self.assertEqual((self.folder / "c.mkv").read_bytes()[:4], b"\x1aE\xdf\xa3")

    def test_cameras(self):
        camera = self.write("c.json", '{"lucerna": "camera/1", "position": [0, 2, 0], "target": [0, 3, -9], "fovY": 60}')
        path = self.write("path.json", '{"lucerna": "camera-path/1", "keyframes": ['
                          '{"time": 0, "position": [0, 2, 0], "target": [0, 3, -9], "fovY": 60},'
                          '{"time": 1, "position": [2, 2, 0], "target": [0, 3, -9], "fovY": 60}]}')
        self.assert_ok(self.lucerna("render", ATRIUM, *SMALL, "--camera", camera, "-o", "a.png"))
        self.assert_ok(self.lucerna("render", ATRIUM, *SMALL, "--camera-path", path, "--frames", 2, "--time-step", 1,
                                    "-o", "p-%d.png"))
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "p-0.png").read_bytes())
        self.assertNotEqual((self.folder / "p-0.png").read_bytes(), (self.folder / "p-1.png").read_bytes())

    def test_compare(self):
        self.assert_ok(self.lucerna("render", ATRIUM, *SMALL, "-o", "a.png"))
        self.assert_ok(self.lucerna("render", ATRIUM, *SMALL, "--exposure", "-2", "-o", "b.png"))
        self.assert_ok(self.lucerna("render", ATRIUM, "--size", "32x32", "-o", "c.png"))
        same = self.lucerna("compare", "a.png", "a.png", "--json", "--fail-above", "0")
        self.assert_ok(same)
        self.assertEqual(json.loads(same.stdout)["flip"]["max"], 0)
        other = self.lucerna("compare", "a.png", "b.png", "--json", "--fail-above", "0.001", "--heatmap", "e.png")
        self.assertEqual(other.returncode, 1)
        self.assertEqual(set(json.loads(other.stdout)), {"flip", "psnr", "ssim", "rmse"})
        self.assertEqual(set(json.loads(other.stdout)["flip"]), {"mean", "weighted_median", "p95", "max"})
        self.assertEqual(png_size(self.folder / "e.png"), (64, 36))
        # A mask whose left half is black, as TGA.
        (self.folder / "mask.tga").write_bytes(struct.pack("<BBBHHBHHHHBB", 0, 0, 3, 0, 0, 0, 0, 0, 64, 36, 8, 32) +
                                               (b"\0" * 32 + b"\xff" * 32) * 36)
        self.assert_ok(self.lucerna("compare", "a.png", "b.png", "--mask", "mask.tga", "--heatmap", "masked.png"))
        masked = self.lucerna("compare", "e.png", "masked.png", "--json")
        self.assertGreater(json.loads(masked.stdout)["flip"]["mean"], 0.1)
        self.assert_fails(3, "64x36", "32x32", arguments=["compare", "a.png", "c.png"])

    def test_json_everywhere(self):
        for arguments in (["info", ATRIUM], ["doctor"], ["pass", "list"], ["pass", "show", "ToneMap"],
                          ["pipeline", "list"], ["pipeline", "check", "deferred"], ["pipeline", "print", "forward"],
                          ["pipeline", "graph", "deferred", "-o", "d.svg"]):
            run = self.lucerna(*arguments, "--json")
            self.assert_ok(run)
            json.loads(run.stdout)
            plain = self.lucerna(*arguments)
            self.assert_ok(plain)
        self.assertIn("<svg", (self.folder / "d.svg").read_text())
        failed = self.lucerna("info", "missing.gltf", "--json")
        self.assertEqual(failed.returncode, 3)
        self.assertEqual(json.loads(failed.stdout)["error"]["code"], 3)

    def test_shipped_pipelines_are_valid_and_render(self):
        listed = self.lucerna("pipeline", "list", "--json")
        self.assert_ok(listed)
        names = json.loads(listed.stdout)["pipelines"]
        self.assertIn("layered", names)
        for name in names:
            self.assert_ok(self.lucerna("pipeline", "check", name))
        for name in ("deferred", "forward", "gbuffer", "bvh"):
            self.assert_ok(self.lucerna("render", ATRIUM, *SMALL, "--pipeline", name, "-o", f"{name}.png"))

    def test_layered_shadows_are_the_same_bits_with_any_number_of_threads(self):
        mask = pathlib.Path(__file__).resolve().parents[2] / "src/passes/shadow_mask/mask_colors.js"
        for pipeline, kind in (("layered", "exr"), (mask, "png")):
            pictures = []
            for threads in ("1", "2", "2"):  # of the software rasteriser
                picture = self.folder / f"of{threads}.{kind}"
                self.assert_ok(self.lucerna("render", "builtin:atrium", "--size", "160x90", "--pipeline", pipeline,
                                            "-o", picture, environment={"LP_NUM_THREADS": threads}))
                pictures.append(picture.read_bytes())
            self.assertEqual(pictures[0], pictures[1])
            self.assertEqual(pictures[1], pictures[2])

    def test_the_example_without_cpp_draws_what_its_page_says(self):
        example = pathlib.Path(__file__).resolve().parents[2] / "examples" / "edges" / "edges.js"
        self.assert_ok(self.lucerna("pipeline", "check", example))
        picture = ["render", ATRIUM, "--size", "160x90", "--pipeline", example]
        self.assert_ok(self.lucerna(*picture, "-o", "edges.png"))
        self.assert_ok(self.lucerna(*picture, "--set", "Edges.enabled=false", "-o", "plain.png"))
        difference = self.lucerna("compare", "plain.png", "edges.png", "--json")
        self.assertGreater(json.loads(difference.stdout)["flip"]["mean"], 0.02)

    def test_quiet_says_nothing(self):
        run = self.lucerna("render", ATRIUM, *SMALL, "-o", "a.png", "--quiet")
        self.assert_ok(run)
        self.assertEqual(run.stdout + run.stderr, "")

    def test_pictures_larger_than_the_drivers_textures_are_drawn_in_tiles(self):
        limit = json.loads(self.lucerna("doctor", "--json").stdout)["gl"]["maxTextureSide"]
        run = self.lucerna("render", ATRIUM, "--size", f"{limit + 3616}x16", "-o", "wide.png")
        self.assert_ok(run)
        self.assertIn("5 tiles of 4096 px", run.stderr)
        self.assertEqual(png_size(self.folder / "wide.png"), (limit + 3616, 16))

    def test_stereo_pictures_hold_both_eyes(self):
        for layout, size in (("sbs", (128, 36)), ("tb", (64, 72)), ("anaglyph", (64, 36))):
            self.assert_ok(self.lucerna("render", ATRIUM, *SMALL, "--stereo", layout, "-o", f"{layout}.png"))
            self.assertEqual(png_size(self.folder / f"{layout}.png"), size)
        for flags in (["--separation", "0.1"], ["--stereo", "sbs", "--convergence", "0"], ["--stereo", "3d"],
                      ["--tile", "8"]):
            run = self.lucerna("render", ATRIUM, *SMALL, "-o", "a.png", *flags)
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertIn("lucerna render --help", run.stderr)
        self.assertFalse((self.folder / "a.png").exists())

    def test_a_row_writes_a_texture_at_its_place(self):
        example = pathlib.Path(__file__).resolve().parents[2] / "examples" / "save_image" / "buffers.js"
        self.assert_ok(self.lucerna("pipeline", "check", example))
        self.assertEqual(list(self.folder.iterdir()), [])
        run = self.lucerna("render", ATRIUM, *SMALL, "--pipeline", example, "--frames", 2, "-o", "p-%d.png", "--json")
        self.assert_ok(run)
        self.assertEqual(sorted(json.loads(run.stdout)["files"]), sorted(path.name for path in self.folder.iterdir()))
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                         [f"{name}-000{frame}.{kind}" for name, kind in
                          (("albedo", "png"), ("depth", "exr"), ("normal", "exr")) for frame in (0, 1)] +
                         ["p-0.png", "p-1.png"])
        run = self.lucerna("pipeline", "check", example, "--set", "Depth.file=depth.png")
        self.assertEqual(run.returncode, 5)
        self.assertIn("Depth32F", run.stderr + run.stdout)
        run = self.lucerna("render", ATRIUM, *SMALL, "--pipeline", example, "--set", "Depth.file=/proc/a.exr",
                           "-o", "q.png")
        self.assertEqual(run.returncode, 1)
        self.assertIn("/proc/a.exr: cannot be written", run.stderr)
        self.assertFalse((self.folder / "q.png").exists())

    def test_a_row_does_not_write_over_another_files(self):
        example = pathlib.Path(__file__).resolve().parents[2] / "examples" / "save_image" / "buffers.js"
        for setting, writers in (("Albedo.file=out.png", "-o and 'Albedo'"),
                                 ("Depth.file=normal-%04d.exr", "'Normal' and 'Depth'")):
            run = self.lucerna("render", ATRIUM, *SMALL, "--pipeline", example, "--set", setting, "-o", "out.png")
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertIn(writers, run.stderr)
        self.assertEqual(list(self.folder.iterdir()), [])

    def interrupted(self, started, *arguments):
        """Runs until `started` matches a file with more than a header, interrupts, and expects exit code
        130; gives stderr."""
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60
        while not any(path.stat().st_size > 64 for path in self.folder.glob(started)) and time.monotonic() < deadline:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, errors)
        return errors

    def interrupted_pictures(self, *flags):
        """Interrupts after the first of endless frames; gives the pictures that are there, whole."""
        self.interrupted("f-*.png", "render", ATRIUM, *SMALL, "--frames", 100000, "-o", "f-%06d.png", *flags)
        pictures = sorted(self.folder.glob("f-*.png"))
        self.assertEqual(sorted(path for path in self.folder.iterdir() if path.suffix == ".png"), pictures)
        for number, path in enumerate(pictures):
            self.assertEqual(path.name, f"f-{number:06}.png")
            self.assertEqual(png_size(path), (64, 36))
            self.assertTrue(path.read_bytes().endswith(b"IEND\xaeB`\x82"), path.name)
        return pictures

    def test_interrupt_ends_with_130_and_leaves_no_partial_file(self):
        pictures = self.interrupted_pictures()
        self.assertEqual(sorted(self.folder.iterdir()), pictures)

    def test_interrupt_keeps_the_profile_of_what_was_drawn(self):
        pictures = self.interrupted_pictures("--profile", "p.csv")
        frames = self.read_profile("p.csv")
        self.assertEqual(len(frames), len(pictures))
        self.check_costs(frames)
        self.assertEqual(sorted(self.folder.iterdir()), [*pictures, self.folder / "p.csv"])

    def test_interrupt_keeps_the_frames_of_a_video(self):
        errors = self.interrupted(".a.tmp*.mp4", "render", ATRIUM, *SMALL, "--frames", 100000, "-o", "a.mp4",
                                  "--profile", "p.csv")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["a.mp4", "p.csv"])
        self.assertIn(f"a.mp4, {mp4_frames(self.folder / 'a.mp4')} frames", errors)


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
