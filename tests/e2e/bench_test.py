#!/usr/bin/env python3
"""lucerna bench from outside: what its files hold, what it leaves out, and how it fails.

Usage: bench_test.py PROGRAM [unittest arguments]
"""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from pages_test import Page

PROGRAM = ""
SUITES = ["passes", "forward", "sraa", "ssao-samples", "shadow-size", "depth-of-field", "soft-shadows",
          "soft-shadows-quality", "bake"]


def small(scene="cornell", cameras=1, rounds=1, size="48x36"):
    return ["--quick", "--scene", f"builtin:{scene}", "--size", size, "--cameras", str(cameras), "--rounds", str(rounds)]


class BenchTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lucerna-bench-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.environment = {k: v for k, v in os.environ.items() if k != "LUCERNA_SCENE_FOLDER"}

    def bench(self, *arguments):
        return subprocess.run([PROGRAM, "bench", *map(str, arguments)], capture_output=True, text=True, timeout=240,
                              cwd=self.folder, env=self.environment, check=False)

    def measured(self, suite, *arguments):
        """The benchmarks by their names and the text of the Markdown file, once the page has been looked over."""
        run = self.bench(suite, *arguments, "-o", "results", "--json")
        self.assertEqual(run.returncode, 0, run.stderr)
        files = json.loads(run.stdout)["files"]
        self.assertEqual(files, [f"results/{suite}{end}" for end in (".json", ".md", ".html")])
        document, text, page = ((self.folder / file).read_text() for file in files)
        self.assertEqual(Page(page).faults, [])
        self.assertNotIn("<script", page)
        self.assertIn("<svg", page)
        self.assertIsNone(re.search(r"\b(nan|inf)\b", page.replace("inf</td>", "")))
        document = json.loads(document)
        for run in document["benchmarks"]:
            self.assertLessEqual({"name", "run_type", "iterations", "real_time", "cpu_time", "time_unit"}, set(run))
        self.assertLessEqual({"date", "num_cpus", "driver", "library_build_type"}, set(document["context"]))
        return {run["name"]: run for run in document["benchmarks"]}, text

    def test_suites_are_listed(self):
        run = self.bench()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual([line.split()[0] for line in run.stdout.splitlines()], [*SUITES, "all"])
        self.assertEqual([s["suite"] for s in json.loads(self.bench("--json").stdout)], SUITES)

    def test_bad_words_are_answered(self):
        for code, words, arguments in (
                (2, ("'sra'", "did you mean 'sraa'"), ["sra", "-o", "r"]),
                (2, ("--output is required",), ["sraa"]),
                (2, ("'file'", "folder"), ["sraa", "-o", "file"]),
                (2, ("--size", "1280x720"), ["sraa", "-o", "r", "--size", "big"]),
                (2, ("--cameras", "1 to 1000"), ["sraa", "-o", "r", "--cameras", "0"]),
                (2, ("called 'cornell'",), ["sraa", "-o", "r", "--scene", "builtin:cornell", "--scene", "builtin:cornell"]),
                (3, ("missing.glb", "no such file"), ["sraa", "-o", "r", "--scene", "missing.glb"]),
                (3, ("'cornel'", "did you mean 'cornell'"), ["sraa", "-o", "r", "--scene", "builtin:cornel"])):
            with self.subTest(arguments):
                (self.folder / "file").write_text("")
                run = self.bench(*arguments)
                self.assertEqual(run.returncode, code, run.stderr)
                for word in words:
                    self.assertIn(word, run.stderr)
                self.assertEqual(run.stdout, "")

    def test_passes_have_times_and_counts_at_both_sizes(self):
        runs, text = self.measured("passes", *small(cameras=2, rounds=3), "--size", "96x72")
        for size in ("48x36", "96x72"):
            for row in ("Cull", "GBuffer", "ShadowMaps", "Sraa", "TiledLighting", "whole frame"):
                name = f"passes/{size}/{row}/cornell"
                median = runs[name + "_median"]
                self.assertEqual(median["iterations"], 6)
                self.assertGreater(median["real_time"], 0)
                self.assertLessEqual(runs[name + "_min"]["real_time"], median["real_time"])
                self.assertLessEqual(median["real_time"], runs[name + "_max"]["real_time"])
        self.assertGreater(runs["passes/48x36/GBuffer/cornell_median"]["primitives"], 1)
        self.assertIn("**96x72 against 48x36, median of the ratios**", text)

    def test_forward_and_deferred_draw_the_same_primitives(self):
        runs, text = self.measured("forward", *small(cameras=2))
        forward, deferred = (runs[f"forward/48x36/{chain}/cornell_median"] for chain in ("forward", "deferred"))
        self.assertEqual(forward["iterations"], 5)  # four frames from one camera to the next
        self.assertEqual(forward["primitives"] + 1, deferred["primitives"])  # TiledLighting's triangle
        self.assertIn("| forward / deferred |", text)

    def test_sraa_is_nearer_to_the_truth_than_nothing(self):
        runs, text = self.measured("sraa", *small(cameras=2))
        begin = "sraa/frame/48x36/no effects/"
        flip = {t: runs[f"{begin}{t}/cornell_median"]["flip"] for t in ("none", "SRAA, depth+normal", "4x supersampling")}
        self.assertLess(flip["SRAA, depth+normal"], flip["none"])
        self.assertLess(flip["4x supersampling"], flip["none"])
        self.assertIn("4x supersampling / SRAA", text)

    def test_ambient_occlusion_has_its_error(self):
        runs, text = self.measured("ssao-samples", *small())
        few, many = (runs[f"ssao-samples/horizon, bilateral/{n}/cornell_median"]["mse"] for n in ("4", "64"))
        self.assertLess(many, few)
        head, table = text.split("**MSE in the time of the hemisphere's 25 samples")[1].split("\n\n")[:2]
        self.assertIn("-: no number", head)
        cells = table.splitlines()[2].strip("| ").split(" | ")
        self.assertTrue(cells[2].endswith("(1.00)"), cells)  # the hemisphere against itself
        for cell in cells[1:]:
            self.assertRegex(cell, r"^(-|[\d.e-]+ \([\d.]+\))$")

    def test_shadow_maps_have_their_error(self):
        runs, _ = self.measured("shadow-size", *small("atrium"))
        coarse, fine = (runs[f"shadow-size/uniform/{n}/atrium_median"] for n in ("512", "2048"))
        self.assertLessEqual(fine["flip"], coarse["flip"])
        self.assertGreater(fine["psnr"], 20)

    def test_depth_of_field_has_its_error(self):
        runs, text = self.measured("depth-of-field", *small("atrium", cameras=3, size="128x72"))
        none, gather = (runs[f"depth-of-field/{n}/atrium/focus before_median"] for n in ("none/-", "gather/8"))
        self.assertLess(gather["flip"], none["flip"])
        self.assertGreater(gather["psnr"], none["psnr"])
        self.assertLess(none["sharp_flip"], none["flip"])
        self.assertIn("| separable, scale 0.75 |", text)

    def test_soft_shadows_have_times_and_counts(self):
        runs, text = self.measured("soft-shadows", *small("penumbra", rounds=3))
        names = [f"soft-shadows/48x36/{maps}/{method}/penumbra_median" for maps in ("redrawn", "kept")
                 for method in ("lighting alone", "hard", "pcss 5+11", "layered 11")]
        for name in names:
            self.assertGreater(runs[name]["real_time"], 0)
        alone, hard, pcss, layered = (runs[name] for name in names[:4])
        self.assertEqual(alone["shadow_texels"], 0)
        self.assertGreater(hard["shadow_texels"], 0)
        self.assertEqual([hard["layers"], layered["layers"], layered["lights_beyond"]], [0, 1, 0])
        self.assertAlmostEqual(pcss["taps"], hard["taps"] * (5 * 5 + 11 * 11))
        self.assertGreater(hard["texture_mib"] * 2**20, alone["texture_mib"] * 2**20 + 3 * hard["shadow_texels"])
        self.assertGreater(hard["draws"], runs[names[5]]["draws"])  # nothing is redrawn that is kept
        self.assertGreater(layered["step_ShadowBlur"], 0)
        self.assertIn("**Ratios of whole frames, 48x36, penumbra: median (quartiles)**", text)
        row = next(line for line in text.splitlines() if line.startswith("| pcss / layered, kernel 11 | redrawn"))
        self.assertRegex(row, r"at least 1.80 \| (met|missed) \| 1.67 \|$")

    def test_soft_shadows_have_their_error(self):
        begin = "soft-shadows-quality/"
        runs, text = self.measured("soft-shadows-quality", *small("penumbra", size="160x90"))
        scene = "penumbra_median"
        noise, hard, pcss, layered = (runs[f"{begin}{method}/{scene}"]
                                      for method in ("reference", "hard", "pcss 5+11", "layered 11"))
        self.assertLess(noise["flip"], pcss["flip"])
        self.assertLess(pcss["penumbra_flip"], hard["penumbra_flip"])
        self.assertGreater(layered["penumbra_psnr"], hard["penumbra_psnr"])
        self.assertGreater(noise["penumbra_psnr"], pcss["penumbra_psnr"])
        self.assertEqual(hard["leak"], 0)
        self.assertEqual(layered["others_steps"], 0)  # there are none
        self.assertIn("**Halo pixels, %**", text)

    def test_the_baker_has_counts_rates_and_packing(self):
        runs, text = self.measured("bake", "--quick", "--scene", "builtin:cornell", "--rounds", 1)
        lamps, surfaces = (runs[f"bake/light/{lights}/cornell_median"] for lights in ("lamps", "all surfaces, 36 m"))
        for run in lamps, surfaces:
            self.assertGreaterEqual(run["pairs"], run["rays"])
            self.assertGreater(run["rays"], 0)
            self.assertEqual(run["thesis_pairs"], run["lights"] * run["maps"] * 2048**2)
        self.assertEqual(lamps["lights"], 1)
        engines = {(engine, lights): runs[f"bake/engine/{engine}/{lights}/cornell_median"]
                   for engine in ("embree", "octree") for lights in ("lamps as points", "all surfaces, 36 m")}
        for run in engines.values():
            self.assertLessEqual(run["share"], 1)
            self.assertGreater(run["all_tracing_s"], 0)
        # A point is one ray for either; a surface is a ray a cell for the octree alone.
        self.assertEqual(engines["embree", "lamps as points"]["pairs"], engines["octree", "lamps as points"]["rays"])
        self.assertGreater(engines["octree", "all surfaces, 36 m"]["rays"],
                           20 * engines["embree", "all surfaces, 36 m"]["rays"])
        for how in ("Embree, ray by ray", "the octree", "without mailboxes", "unsorted"):
            self.assertGreater(runs[f"bake/rate/octree's rays: {how}/lamps/cornell_median"]["mrays_s"], 0)
        for how in ("Embree, packets of 16", "Embree, ray by ray", "the tracer alone", "light stage: tracing"):
            self.assertGreater(runs[f"bake/rate/{how}/lamps/cornell_median"]["mrays_s"], 0)
        masks, rectangles = (runs[f"bake/packing/{how}/cornell_median"] for how in ("masks", "rectangles"))
        self.assertGreater(masks["occupancy"], 0)
        self.assertEqual(masks["charts"], rectangles["charts"])
        self.assertNotIn("camera", text)

    def test_what_does_not_come_with_lucerna_is_skipped_with_a_word(self):
        arguments = ["forward", "--quick", "--size", "16x12", "--cameras", 1, "--rounds", 1]
        for more, reason in (([], "no --scene-folder"), (["--scene-folder", "nowhere"], "is not there")):
            runs, text = self.measured(*arguments, *more)
            self.assertIn("Skipped: sponza, as", text)
            self.assertIn(reason, text)
            self.assertIn("forward/16x12/forward/atrium_median", runs)

    def test_after_ctrl_c_the_tables_say_so(self):
        process = subprocess.Popen([PROGRAM, "bench", "forward", *small(cameras=50, rounds=1000), "-o", "results"],
                                   cwd=self.folder, env=self.environment, stderr=subprocess.PIPE, text=True)
        time.sleep(3)
        process.send_signal(signal.SIGINT)
        _, talk = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, talk)
        self.assertIn("Cancelled: scenes are missing.", (self.folder / "results" / "forward.md").read_text())
        context = json.loads((self.folder / "results" / "forward.json").read_text())["context"]
        self.assertTrue(context["suites"]["forward"]["cancelled"])
        self.assertNotEqual(context["driver"], "")

    def test_a_scene_that_cannot_be_read_costs_no_other(self):
        (self.folder / "broken.gltf").write_text("{")
        run = self.bench("forward", *small(), "--scene", "broken.gltf", "-o", "results", "--json")
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertIn("broken.gltf", run.stderr)
        self.assertTrue(json.loads(run.stdout)["failed"])
        self.assertIn("- Failed: broken: ", (self.folder / "results" / "forward.md").read_text())
        document = json.loads((self.folder / "results" / "forward.json").read_text())
        self.assertIn("Failed: broken: ", document["context"]["suites"]["forward"]["notes"][0])
        self.assertIn("forward/48x36/forward/cornell_median", [run["name"] for run in document["benchmarks"]])

    def test_where_no_scene_can_be_read_nothing_is_written(self):
        (self.folder / "broken.gltf").write_text("{")
        run = self.bench("all", "--quick", "--scene", "broken.gltf", "-o", "results")
        self.assertEqual(run.returncode, 3, run.stderr)
        self.assertEqual(list((self.folder / "results").iterdir()), [])

    def test_a_chain_that_cannot_run_costs_no_other(self):
        broken = self.folder / "shaders" / "passes" / "fxaa" / "fxaa.frag"
        broken.parent.mkdir(parents=True)
        broken.write_text("void main() {\n  nonsense;\n}\n")
        run = self.bench("sraa", *small(), "--shaders", "shaders", "-o", "results")
        self.assertEqual(run.returncode, 1, run.stderr)
        text = (self.folder / "results" / "sraa.md").read_text()
        self.assertIn("- Failed: frame, 48x36, no effects, Fxaa, cornell: ", text)
        row = next(line for line in text.splitlines() if line.startswith("| cornell | ") and "| - |" in line)
        self.assertEqual(row.count(" - "), 1, row)


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
