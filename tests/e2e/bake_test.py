#!/usr/bin/env python3
"""lucerna bake and lucerna lightmap from outside: whole, in parts, killed, on several threads, the same files come
out; and what is missing or damaged is named.

Usage: bake_test.py PROGRAM [unittest arguments]
"""
import contextlib
import hashlib
import json
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = ""
SCENE = "builtin:cornell"
SMALL = ["--density", "40", "--size", "128", "--preset", "preview"]
# Light that takes a second or two, and several units for each of five shards.
LONG = ["--density", "400", "--size", "1024", "--preset", "standard"]
DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs" / "user"


def faults(value, schema, place="manifest"):
    """What JSON schema's words that ours use find wrong."""
    kinds = {"object": dict, "array": list, "string": str, "integer": int, "number": (int, float)}
    kind = schema.get("type")
    if kind and (not isinstance(value, kinds[kind]) or isinstance(value, bool)):
        return [f"{place}: is no {kind}"]
    found = []
    if "const" in schema and value != schema["const"]:
        found.append(f"{place}: is not {schema['const']}")
    if "enum" in schema and value not in schema["enum"]:
        found.append(f"{place}: is none of {schema['enum']}")
    if "pattern" in schema and not re.search(schema["pattern"], value):
        found.append(f"{place}: does not match {schema['pattern']}")
    if value < schema["minimum"] if "minimum" in schema else False:
        found.append(f"{place}: is below {schema['minimum']}")
    if isinstance(value, dict):
        properties = schema.get("properties", {})
        found += [f"{place}: lacks {key}" for key in schema.get("required", []) if key not in value]
        for key, member in value.items():
            if key in properties:
                found += faults(member, properties[key], f"{place}/{key}")
            elif schema.get("additionalProperties") is False:
                found.append(f"{place}: {key} is unknown")
    if isinstance(value, list):
        if len(value) < schema.get("minItems", 0) or len(value) > schema.get("maxItems", len(value)):
            found.append(f"{place}: has {len(value)} items")
        for i, item in enumerate(value):
            found += faults(item, schema.get("items", {}), f"{place}/{i}")
    return found


def schema():
    """The manifest's, with what it refers to in place."""
    whole = json.loads((DOCS / "lightmap.schema.json").read_text())

    def resolved(part):
        if isinstance(part, dict):
            if "$ref" in part:
                return resolved(whole["$defs"][part["$ref"].removeprefix("#/$defs/")])
            return {key: resolved(each) for key, each in part.items() if key != "$defs"}
        return [resolved(each) for each in part] if isinstance(part, list) else part
    return resolved(whole)


class BakeTest(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lucerna-bake-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def lucerna(self, *arguments, **options):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=240,
                              cwd=self.folder, check=False, **options)

    def bake(self, folder, *flags, scene=SCENE, **options):
        return self.lucerna("bake", scene, "-o", folder, *flags, **options)

    def ok(self, run):
        self.assertEqual(run.returncode, 0, run.stderr)
        return run

    def fails(self, code, run, *words):
        self.assertEqual(run.returncode, code, run.stderr)
        for word in words:
            self.assertIn(word, run.stderr)
        self.assertEqual(run.stderr.count("error:"), 1, run.stderr)

    def hashes(self, folder):
        """Of every file in it, by name."""
        root = self.folder / folder
        return {str(path.relative_to(root)): hashlib.sha256(path.read_bytes()).hexdigest()
                for path in sorted(root.rglob("*")) if path.is_file()}

    def manifest(self, folder):
        return json.loads((self.folder / folder / "manifest.json").read_text())

    def whole(self, folder, *flags):
        """The hashes of a plain bake, once it is seen that its manifest names all of its files."""
        self.ok(self.bake(folder, *flags))
        found, manifest = self.hashes(folder), self.manifest(folder)
        named = {"manifest.json", manifest["layout"]["file"]}
        for entry in manifest["maps"]:
            named |= {entry["master"]["file"], *(each["file"] for each in entry["encoded"])}
        named |= {each["file"] for each in [*manifest["patches"], *manifest["gltf"]]}
        self.assertEqual(set(found), named)
        self.assertEqual([path for path in (self.folder / folder).iterdir() if path.is_dir()], [])
        return found

    # The same files, however they were made

    def test_threads_do_not_matter(self):
        plain = self.whole("plain", *SMALL)
        for threads in (1, 2, 4):
            self.ok(self.bake(f"t{threads}", *SMALL, "--threads", threads))
            self.assertEqual(self.hashes(f"t{threads}"), plain)

    def test_threads_do_not_matter_to_the_octree(self):
        flags = [*SMALL[:-1], "standard", "--engine", "octree"]
        plain = self.whole("plain", *flags, "--threads", 1)
        self.ok(self.bake("t4", *flags, "--threads", 4))
        self.assertEqual(self.hashes("t4"), plain)
        self.assertNotEqual(self.whole("embree", *SMALL[:-1], "standard"), plain)

    def test_shards_do_not_matter(self):
        plain = self.whole("plain", *SMALL)
        for count in (1, 2, 5):
            folder = f"s{count}"
            for shard in range(count, 0, -1):
                self.ok(self.bake(folder, *SMALL, "--shard", f"{shard}/{count}"))
            if count > 1:
                self.assertFalse((self.folder / folder / "manifest.json").exists())
                document = json.loads(self.ok(self.lucerna("lightmap", "merge", folder, "--json")).stdout)
                self.assertTrue(document["finished"])
            self.assertEqual(self.hashes(folder), plain)
        again = self.ok(self.lucerna("lightmap", "merge", "s5"))
        self.assertIn("nothing is left to merge", again.stderr)

    def test_shards_of_the_final_preset_are_merged(self):
        flags = ["--density", "20", "--size", "128", "--preset", "final"]
        plain = self.whole("plain", *flags)
        for shard in (1, 2):
            self.ok(self.bake("f", *flags, "--shard", f"{shard}/2"))
        self.ok(self.lucerna("lightmap", "merge", "f"))
        self.assertEqual(self.hashes("f"), plain)

    def test_shards_may_be_divided_anew(self):
        plain = self.whole("plain", *SMALL)
        self.ok(self.bake("d", *SMALL, "--shard", "2/3"))
        document = json.loads(self.ok(self.bake("d", *SMALL, "--json")).stdout)
        self.assertGreater(document["bake"]["units_before"], 0)
        self.assertEqual(self.hashes("d"), plain)

    @contextlib.contextmanager
    def held(self, reached, *arguments):
        """A run that stands still from when reached() is true until the block ends, and goes on to a good end."""
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 120
        while process.poll() is None and not reached() and time.monotonic() < deadline:
            time.sleep(0.0005)
        process.send_signal(signal.SIGSTOP)
        os.waitid(os.P_PID, process.pid, os.WSTOPPED | os.WEXITED | os.WNOWAIT)  # all of its threads
        try:
            yield
        finally:
            process.send_signal(signal.SIGCONT)
            said = process.communicate(timeout=120)[1]
        self.assertEqual(process.returncode, 0, said)

    def end(self, folder, sign, reached, *flags):
        """Starts a bake, ends it once reached() is true, and gives its exit code."""
        return self.end_run(["bake", SCENE, "-o", folder, *flags], sign, reached)

    def end_run(self, arguments, sign, reached):
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 120
        ready = lambda: reached() and (sign != signal.SIGINT or self.hears(process))
        while process.poll() is None and not ready() and time.monotonic() < deadline:
            time.sleep(0.0005)
        process.send_signal(sign)
        self.said = process.communicate(timeout=120)[1]
        return process.returncode

    def hears(self, process):
        """Whether it has begun to listen for Ctrl-C."""
        status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
        return int(re.search(r"SigCgt:\s*(\w+)", status)[1], 16) >> (signal.SIGINT - 1) & 1

    def logged(self, folder, count):
        """Whether the log of the only shard has so many bytes."""
        log = self.folder / folder / "work" / "shard-1-of-1.log"

        def reached():
            try:
                return log.stat().st_size >= count
            except FileNotFoundError:
                return False
        return reached

    def written(self, folder, count):
        """Whether so many maps are written or being written."""
        return lambda: len(list((self.folder / folder).glob("*map*"))) >= count

    def random_moment(self, chance, folder, seconds):
        """Any time, some way through the light, or while the maps are written."""
        kind = chance.randrange(3)
        if kind == 0:
            end = time.monotonic() + chance.uniform(0, seconds)
            return lambda: time.monotonic() >= end
        if kind == 1:
            return self.logged(folder, chance.randrange(1, 12 << 20))
        return self.written(folder, chance.randint(1, 7))

    def resume(self, folder):
        """What goes on with an unfinished bake, and replaces a finished one."""
        return ["--resume"] if (self.folder / folder / "work" / "bake.json").exists() else []

    def test_what_is_killed_goes_on(self):
        seed = int(os.environ.get("LUCERNA_KILL_SEED", random.randrange(1 << 30)))
        print(f"LUCERNA_KILL_SEED={seed}", end=" ", file=sys.stderr, flush=True)
        chance = random.Random(seed)
        start = time.monotonic()
        plain = self.whole("plain", *LONG)
        seconds = time.monotonic() - start
        self.whole("older", "--density", "150", "--size", "128", "--preset", "preview", "--encode", "png")
        self.assertGreater(len(self.manifest("older")["maps"]), 2 * len(self.manifest("plain")["maps"]))
        wanted, kills = 20, 0
        for number in range(wanted):
            folder = f"k{number}"
            if number % 2:
                shutil.copytree(self.folder / "older", self.folder / folder)
            for _ in range(4):  # some are over before their moment comes
                reached = self.random_moment(chance, folder, seconds)
                flags = [*LONG, *self.resume(folder)]
                kills += self.end(folder, signal.SIGKILL, reached, *flags) == -signal.SIGKILL
            self.ok(self.bake(folder, *LONG, *self.resume(folder)))
            self.assertEqual(self.hashes(folder), plain, f"seed {seed}, {folder}")
            shutil.rmtree(self.folder / folder)
            if kills >= wanted:
                return
        self.fail(f"seed {seed}: {kills} of {wanted} bakes were killed, the others were over before")

    def test_little_work_can_be_lost(self):
        """Seconds of one thread's work between two records of the log: a kill loses no more of any thread's."""
        log = self.folder / "g" / "work" / "shard-1-of-1.log"
        process = subprocess.Popen([PROGRAM, "bake", SCENE, "-o", "g", *LONG, "--threads", "1"], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        ticks = os.sysconf("SC_CLK_TCK")
        size, last, longest, growths = 0, 0., 0., 0
        while process.poll() is None:
            try:
                fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
                now, worked = log.stat().st_size, (int(fields[11]) + int(fields[12])) / ticks
            except (FileNotFoundError, IndexError, ProcessLookupError):
                now = 0
            if now > size:
                longest, growths = max(longest, worked - last), growths + 1
                size, last = now, worked
            time.sleep(0.005)
        self.assertEqual(process.returncode, 0)
        self.assertGreater(growths, 10)
        self.assertLess(longest, 5)

    def test_interrupt_keeps_what_is_done(self):
        plain = self.whole("plain", *LONG)
        self.assertEqual(self.end("i", signal.SIGINT, self.logged("i", 1 << 16), *LONG), 130)
        self.assertIn("error: cancelled; what is lit is kept in 'i': the same command with --resume goes on\n",
                      self.said)
        self.assertFalse((self.folder / "i" / "manifest.json").exists())
        self.fails(2, self.bake("i", *LONG), "--resume")
        document = json.loads(self.ok(self.bake("i", *LONG, "--resume", "--json")).stdout)
        self.assertGreater(document["bake"]["units_before"], 0)
        self.assertEqual(self.hashes("i"), plain)

    def test_interrupt_while_writing_is_heard(self):
        plain = self.whole("plain", *LONG)

        def check(folder, code):
            self.assertEqual(code, 130)
            self.assertFalse((self.folder / folder / "manifest.json").exists())
            self.assertTrue((self.folder / folder / "work" / "bake.json").exists())
        check("w", self.end("w", signal.SIGINT, self.written("w", 1), *LONG))
        # What is lit stays lit.
        document = json.loads(self.ok(self.bake("w", *LONG, "--resume", "--json")).stdout)
        self.assertEqual(document["bake"]["units_before"], document["bake"]["units"])
        self.assertEqual(self.hashes("w"), plain)
        for shard in (1, 2):
            self.ok(self.bake("m", *LONG, "--shard", f"{shard}/2"))
        merge = ["lightmap", "merge", "m"]
        check("m", self.end_run(merge, signal.SIGINT, self.written("m", 1)))
        self.assertIn("error: cancelled; what the shards have lit is kept in 'm': the same command merges it\n",
                      self.said)
        layout = self.folder / "m" / "layout.bin"
        layout.unlink()
        check("m", self.end_run(merge, signal.SIGINT, layout.exists))
        self.ok(self.lucerna(*merge))
        self.assertEqual(self.hashes("m"), plain)

    def test_leftovers_of_a_kill_while_writing_are_cleared(self):
        plain = self.whole("plain", *SMALL)
        self.ok(self.bake("l", *SMALL, "--shard", "1/2"))
        (self.folder / "l" / ".map-000.tmp-1-0.exr").write_bytes(b"half of a map")
        self.ok(self.bake("l", *SMALL, "--shard", "2/2"))
        self.ok(self.lucerna("lightmap", "merge", "l"))
        self.assertEqual(self.hashes("l"), plain)
        # Of a bake with more maps, killed before its manifest: over an older one, and alone; its work removed, as
        # the messages say.
        many = ["--density", "800", "--size", "128", "--preset", "preview", "--encode", "bc6h"]
        for folder in ("l", "k"):
            self.assertEqual(self.end(folder, signal.SIGKILL, self.written(folder, 30), *many), -signal.SIGKILL)
            self.fails(2, self.bake(folder, *SMALL), "remove 'DIR/work'".replace("DIR", folder))
            shutil.rmtree(self.folder / folder / "work")
            self.assertGreater(len(self.hashes(folder)), len(plain))
            self.ok(self.bake(folder, *SMALL))
            self.assertEqual(self.hashes(folder), plain)
        # Killed after the manifest, before all is cleared: as the same files would be then.
        names = ["map-009.exr", "tex-777.png"]
        (self.folder / "k" / "unfinished.json").write_text(json.dumps({"lucerna": "unfinished/1", "files": names[:1]}))
        for name in names:
            (self.folder / "k" / name).write_bytes(b"")
        self.fails(2, self.bake("k", *SMALL, "--resume"), "tex-777.png", "none of a lightmap")
        (self.folder / "k" / "tex-777.png").unlink()
        self.ok(self.bake("k", *SMALL, "--resume"))
        self.assertEqual(self.hashes("k"), plain)

    def test_finished_is_finished(self):
        plain = self.whole("f", *SMALL)
        run = self.ok(self.bake("f", *SMALL, "--resume", "--json"))
        self.assertIn("'f' is finished", run.stderr)
        self.assertTrue(json.loads(run.stdout)["finished"])
        self.assertEqual(self.hashes("f"), plain)
        self.fails(2, self.bake("f", *SMALL, "--padding", 3, "--resume"),
                   "other settings: --padding is 2 there, 3 here; give the same, or bake without --resume")
        self.fails(2, self.bake("f", *SMALL, "--resume", scene="builtin:cornell?boxes=0"), "another scene: '")
        self.assertEqual(self.hashes("f"), plain)
        (self.folder / "f" / "map-000.exr").write_bytes(b"")
        said = self.ok(self.bake("f", *SMALL, "--resume")).stderr
        self.assertRegex(said, "map-000.exr: is damaged .* as the manifest says; this bakes it again\n")
        (self.folder / "f" / "map-000.exr").unlink()
        self.fails(3, self.lucerna("lightmap", "inspect", "f"),
                   "map-000.exr: is gone, and the manifest names it; `lucerna bake ... --resume` makes it again")
        self.assertIn("the manifest names it; this bakes it again",
                      self.ok(self.bake("f", *SMALL, "--resume")).stderr)
        self.assertEqual(self.hashes("f"), plain)

    def test_copies_are_added_to_a_finished_bake(self):
        plain = self.whole("plain", *SMALL, "--encode", "rgb9e5,bc6h,png")
        self.whole("d", *SMALL)
        master = (self.folder / "d" / "map-000.exr").stat().st_mtime_ns
        run = self.ok(self.bake("d", *SMALL, "--encode", "bc6h", "--resume", "--json"))
        self.assertIn("wrote copies (bc6h) of 5 maps", run.stderr)
        self.assertNotIn("bake", json.loads(run.stdout))
        self.assertEqual(self.hashes("d"), self.whole("bc6h", *SMALL, "--encode", "bc6h"))
        # One that is there is not made again, whether it is asked for or not.
        copy = (self.folder / "d" / "map-000.bc6h.ktx2").stat().st_mtime_ns
        self.assertIn("wrote copies (rgb9e5, png) of 5 maps",
                      self.ok(self.bake("d", *SMALL, "--encode", "png,rgb9e5", "--resume")).stderr)
        self.assertEqual(self.hashes("d"), plain)
        self.assertEqual((self.folder / "d" / "map-000.exr").stat().st_mtime_ns, master)
        self.assertEqual((self.folder / "d" / "map-000.bc6h.ktx2").stat().st_mtime_ns, copy)
        for encodings, others in (([], "rgb9e5, bc6h, png"), (["--encode", "png"], "rgb9e5, bc6h")):
            self.assertIn(f"'d' is finished, and also has copies {others}; nothing is left to do",
                          self.ok(self.bake("d", *SMALL, *encodings, "--resume")).stderr)
        self.fails(2, self.bake("d", *SMALL, "--padding", 3, "--encode", "png", "--resume"), "--padding is 2 there")
        self.assertEqual(self.hashes("d"), plain)
        self.assertEqual(list(self.whole("d", *SMALL)), list(self.whole("bare", *SMALL)))  # without --resume they go
        # A master that is damaged: all is baked again. A file of another's is in the way.
        self.whole("d", *SMALL)
        (self.folder / "d" / "map-001.exr").write_bytes(b"")
        flags = [*SMALL, "--encode", "rgb9e5,bc6h,png", "--resume"]
        self.assertIn("this bakes it again", self.ok(self.bake("d", *flags)).stderr)
        self.assertEqual(self.hashes("d"), plain)
        before = self.whole("d", *SMALL)
        (self.folder / "d" / "map-000.png").write_text("mine")
        self.fails(2, self.bake("d", *flags), "'map-000.png'")
        (self.folder / "d" / "map-000.png").unlink()
        self.assertEqual(self.hashes("d"), before)

    def test_adding_copies_can_be_killed(self):
        large = ["--density", "800", "--size", "256", "--preset", "preview"]
        flags = [*large, "--encode", "bc6h"]
        plain, old = self.whole("plain", *flags), self.whole("d", *large)
        copies = lambda: len(list((self.folder / "d").glob("map-*.bc6h.ktx2"))) > 2
        self.assertEqual(self.end("d", signal.SIGKILL, copies, *flags, "--resume"), -signal.SIGKILL)
        self.assertEqual(os.listdir(self.folder / "d" / "work"), ["bake.lock"])
        self.ok(self.lucerna("lightmap", "inspect", "d"))
        self.assertIn("nothing is left to do", self.ok(self.bake("d", *large, "--resume")).stderr)
        self.assertEqual(self.hashes("d"), old)
        self.assertEqual(self.end("d", signal.SIGINT, copies, *flags, "--resume"), 130)
        self.assertIn("error: cancelled; the lightmap in 'd' is as it was, and some copies lie beside it: the same "
                      "command writes them all\n", self.said)
        self.ok(self.lucerna("lightmap", "inspect", "d"))
        self.ok(self.bake("d", *flags, "--resume"))
        self.assertEqual(self.hashes("d"), plain)

    # Several processes at once

    BUSY = "another process writes into it at the moment; wait for it"

    def refuses_beside(self, folder, *runs):
        """Each of these runs, beside one that is held, says who is in the way and changes nothing."""
        before = self.hashes(folder)
        for run in runs:
            self.fails(1, self.lucerna(*run), self.BUSY, f"'{folder}'")
            self.assertEqual(self.hashes(folder), before)

    def test_one_process_at_a_time_adds_copies(self):
        large = ["--density", "800", "--size", "256", "--preset", "preview"]
        adding = [*large, "--resume", "--encode"]
        plain = self.whole("plain", *large, "--encode", "bc6h")
        self.whole("d", *large)
        copies = lambda: len(list((self.folder / "d").glob("map-*.bc6h.ktx2"))) > 2
        with self.held(copies, "bake", SCENE, "-o", "d", *adding, "bc6h"):
            self.refuses_beside("d", ["bake", SCENE, "-o", "d", *adding, "png"],
                                ["bake", SCENE, "-o", "d", *adding, "bc6h"], ["bake", SCENE, "-o", "d", *large])
            # Finished it is all the same, and what the other needs stays.
            before = self.hashes("d")
            self.ok(self.bake("d", *large, "--resume"))
            self.ok(self.lucerna("lightmap", "merge", "d"))
            self.assertEqual(self.hashes("d"), before)
        self.assertEqual(self.hashes("d"), plain)

    def test_one_process_at_a_time_writes_maps(self):
        plain = self.whole("plain", *LONG)
        for shard in (1, 2):
            self.ok(self.bake("m", *LONG, "--shard", f"{shard}/2"))
        merge = ["lightmap", "merge"]
        for folder, run in (("w", ["bake", SCENE, "-o", "w", *LONG]), ("m", [*merge, "m"])):
            with self.held(self.written(folder, 1), *run):
                self.assertFalse((self.folder / folder / "manifest.json").exists())
                self.refuses_beside(folder, ["bake", SCENE, "-o", folder, *LONG, "--resume"], [*merge, folder],
                                    ["bake", SCENE, "-o", folder, *LONG, "--shard", "2/3"])
            self.assertEqual(self.hashes(folder), plain)

    def test_shards_light_side_by_side_and_none_is_merged_meanwhile(self):
        plain = self.whole("plain", *LONG)
        log = self.folder / "s" / "work" / "shard-1-of-2.log"
        lit = lambda: log.exists() and log.stat().st_size > 1 << 16
        with self.held(lit, "bake", SCENE, "-o", "s", *LONG, "--shard", "1/2"):
            self.ok(self.bake("s", *LONG, "--shard", "2/2"))
            self.refuses_beside("s", ["lightmap", "merge", "s"])
            self.fails(1, self.bake("s", *LONG, "--shard", "1/2", "--resume"), "another process bakes this part")
        self.ok(self.lucerna("lightmap", "merge", "s"))
        self.assertEqual(self.hashes("s"), plain)

    def test_a_new_bake_replaces_all_of_an_old_one(self):
        self.whole("r", "--density", "80", "--size", "64", "--preset", "preview")
        self.assertGreater(len(self.manifest("r")["maps"]), 1)
        self.assertEqual(self.whole("r", *SMALL), self.whole("plain", *SMALL))

    # What does not fit together

    def test_other_settings_are_named(self):
        self.ok(self.bake("o", *SMALL, "--shard", "1/2"))
        self.fails(2, self.bake("o", "--density", "41", *SMALL[2:], "--shard", "2/2"),
                   "--density is 40 there, 41 here", "remove 'o/work'")
        self.fails(2, self.bake("o", *SMALL[:-1], "standard", "--shard", "2/2"),
                   "other settings: --preset is preview there, standard here; give the same")
        self.fails(2, self.bake("o", *SMALL, "--reach", 3, "--shard", "2/2"), "reach is none there, 3 here")
        self.fails(2, self.bake("o", *SMALL, "--shard", "2/2", scene="builtin:cornell?boxes=0"), "another scene",
                   "'builtin:cornell' there", "'builtin:cornell?boxes=0' here")
        self.assertEqual(sorted(os.listdir(self.folder / "o" / "work")), ["bake.json", "bake.lock", "shard-1-of-2.log"])

    def test_the_order_of_lists_is_no_setting(self):
        (self.folder / "floor.obj").write_text("v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3 4\n")
        (self.folder / "lamps.json").write_text(json.dumps(
            {"lucerna": "scene/1", "include": [{"file": "floor.obj"}],
             "lights": [{"name": group, "kind": "point", "intensity": 100, "position": [0, 1, 0], "group": group}
                        for group in "ab"]}))
        self.ok(self.bake("l", *SMALL, "--encode", "rgb9e5,bc6h", "--lights", "b,a", scene="lamps.json"))
        run = self.ok(self.bake("l", *SMALL, "--encode", "bc6h,rgb9e5,bc6h", "--lights", "a,b", "--resume",
                                scene="lamps.json"))
        self.assertIn("nothing is left to do", run.stderr)
        self.fails(2, self.bake("l", *SMALL, "--encode", "bc6h", "--lights", "a", "--resume", scene="lamps.json"),
                   "--lights is a,b there, a here")

    def test_a_scene_file_that_changed_is_refused(self):
        lamp = {"kind": "point", "intensity": 100, "position": [0, 1, 0]}

        def write(name, lamp):
            (self.folder / name).write_text(json.dumps(
                {"lucerna": "scene/1", "include": [{"file": "box.obj"}], "lights": [lamp]}))
        (self.folder / "box.obj").write_text("v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3 4\n")
        write("a.json", lamp)
        self.ok(self.bake("c", *SMALL, "--shard", "1/2", scene="a.json"))
        self.assertEqual(json.loads((self.folder / "c/work/bake.json").read_text())["scene"],
                         str((self.folder / "a.json").resolve()))
        write("a.json", {**lamp, "intensity": 50})
        self.fails(2, self.bake("c", *SMALL, "--shard", "2/2", scene="a.json"), "before it changed")
        self.fails(2, self.lucerna("lightmap", "merge", "c"), "before it changed")
        write("a.json", lamp)
        os.makedirs(self.folder / "elsewhere")  # the same scene, from another place
        (self.folder / "elsewhere" / "box.obj").write_text((self.folder / "box.obj").read_text())
        (self.folder / "elsewhere" / "a.json").write_text((self.folder / "a.json").read_text())
        self.ok(self.bake("c", *SMALL, "--shard", "2/2", scene="elsewhere/a.json"))
        self.ok(self.lucerna("lightmap", "merge", "c", "--scene", "elsewhere/a.json"))

    def test_missing_parts_are_named(self):
        self.fails(3, self.lucerna("lightmap", "merge", "nothing"), "work/bake.json")
        for shard in (1, 2, 4, 5):
            self.ok(self.bake("m", *SMALL, "--shard", f"{shard}/5"))
        self.fails(1, self.lucerna("lightmap", "merge", "m"), "shard 3 of 5 has no log", "--resume")
        self.assertFalse((self.folder / "m" / "manifest.json").exists())
        run = self.lucerna("lightmap", "merge", "m", "--json")
        self.assertIn("shard 3 of 5", json.loads(run.stdout)["error"]["message"])

    def test_damage_is_named_and_never_used(self):
        plain = self.whole("plain", *SMALL)
        whole = None
        chance = random.Random(7)
        for number in range(12):
            folder = f"b{number}"
            for shard in (1, 2):
                # Of one thread, a log has its records in the same order each time.
                self.ok(self.bake(folder, *SMALL, "--shard", f"{shard}/2", "--threads", "1"))
            log = self.folder / folder / "work" / "shard-2-of-2.log"
            content = bytearray(log.read_bytes())
            whole = whole or bytes(content)
            self.assertEqual(bytes(content), whole)
            if number == 11:
                log.write_bytes(content[:-5])  # torn
                at = len(content) - 5
            else:
                at = (0, 12, 33, 36, 48, 60)[number] if number < 6 else chance.randrange(64, len(content))
                content[at] ^= 1 << chance.randrange(8)
                log.write_bytes(content)
            run = self.lucerna("lightmap", "merge", folder)
            self.fails(1, run, "shard 2 of 2 lacks", "--resume")
            if number < 11:
                self.assertLessEqual(int(re.search(r"damaged \w+ at byte (\d+)", run.stderr)[1]), at)
            self.assertFalse((self.folder / folder / "manifest.json").exists())
            self.ok(self.bake(folder, *SMALL, "--shard", "2/2", "--resume"))
            self.ok(self.lucerna("lightmap", "merge", folder))
            self.assertEqual(self.hashes(folder), plain, f"byte {at}")

    # Where it cannot be written

    def test_folders_that_will_not_do(self):
        (self.folder / "file").write_text("")
        self.fails(2, self.bake("file", *SMALL), "'file' is a file")
        self.fails(1, self.bake("file/below", *SMALL), "no folder that can be written")
        os.makedirs(self.folder / "other")
        (self.folder / "other" / "letter.txt").write_text("")
        self.fails(2, self.bake("other", *SMALL), "none of a lightmap")
        self.fails(1, self.bake("/proc/lightmap", *SMALL), "/proc")
        self.fails(2, self.lucerna("bake", SCENE), "-o")
        self.assertEqual(sorted(os.listdir(self.folder)), ["file", "other"])

    def test_a_scene_is_never_replaced(self):
        self.whole("first", *SMALL)
        os.makedirs(self.folder / "m")
        for name in ("scene.gltf", "scene.bin"):
            (self.folder / "m" / name).write_bytes((self.folder / "first" / name).read_bytes())
        before = self.hashes("m")
        self.fails(2, self.bake("m", *SMALL, scene="m/scene.gltf"), "the folder of the scene", "m/bake")
        (self.folder / "other.json").write_text(json.dumps(
            {"lucerna": "scene/1", "include": [{"file": "m/scene.gltf"}]}))
        self.fails(2, self.bake("m", *SMALL, scene="other.json"), "none of a lightmap")
        self.assertEqual(self.hashes("m"), before)
        (self.folder / "m" / "work").mkdir()
        self.fails(2, self.bake("m", *SMALL), "none of a lightmap")
        before = self.hashes("first")  # a lightmap, but the scene is its copy
        self.fails(2, self.bake("first", *SMALL, scene="first/scene.gltf"), "the folder of the scene")
        self.assertEqual(self.hashes("first"), before)
        self.ok(self.bake("m/bake", *SMALL, scene="m/scene.gltf"))

    def test_folders_of_others_are_left_alone(self):
        web = self.folder / "web"
        os.makedirs(web)
        for name in ("manifest.json", "map-1.png", "map-000.exr", "tex-0.png"):
            (web / name).write_text('{"name": "A page", "lucerna": "no lightmap/1"}')
        before = self.hashes("web")
        self.fails(2, self.bake("web", *SMALL), "none of a lightmap")
        (web / "manifest.json").unlink()
        self.fails(2, self.bake("web", *SMALL), "none of a lightmap")
        del before["manifest.json"]
        self.assertEqual(self.hashes("web"), before)
        # What else was put into a lightmap's folder stays.
        plain = self.whole("ours", *SMALL)
        names = {"map-1.png", "map-1000.txt", "tex-0.png", "notes.txt", "maps/map-001.exr"}
        os.makedirs(self.folder / "ours" / "maps")
        for name in names:
            (self.folder / "ours" / name).write_text(name)
        self.ok(self.bake("ours", *SMALL))
        self.ok(self.bake("ours", *SMALL, "--resume"))
        kept = self.hashes("ours")
        self.assertEqual({name: kept[name] for name in plain}, plain)
        self.assertEqual(set(kept) - set(plain), names)
        # What is named like a lightmap's is refused before anything is done.
        os.makedirs(self.folder / "ours" / "work")
        for name in ("map-777.exr", "tex-777.png", "work/diary.txt", "unfinished.json"):
            (self.folder / "ours" / name).write_text(name)
            before = self.hashes("ours")
            words = ["ours/unfinished.json:", "remove it"] if name == "unfinished.json" else [
                "none of a lightmap", f"'{name}'"]
            for flags in ([], ["--resume"], ["--shard", "1/2"]):
                self.fails(2, self.bake("ours", *SMALL, *flags, scene="no scene is read"), *words)
            self.assertEqual(self.hashes("ours"), before)
            (self.folder / "ours" / name).unlink()

    def test_what_is_put_there_while_it_bakes_is_left_alone(self):
        for shard in (1, 2):
            self.ok(self.bake("d", *SMALL, "--shard", f"{shard}/2"))
        for name in ("scene.bin", "work/diary.txt"):
            (self.folder / "d" / name).write_text(name)
            self.fails(2, self.lucerna("lightmap", "merge", "d"), "none of a lightmap", f"'{name}'")
            self.assertEqual((self.folder / "d" / name).read_text(), name)
            (self.folder / "d" / name).unlink()
        (self.folder / "d" / "notes.txt").write_text("")
        self.ok(self.lucerna("lightmap", "merge", "d"))
        self.assertEqual(set(self.hashes("d")), set(self.whole("plain", *SMALL)) | {"notes.txt"})

    def test_a_damaged_manifest_is_refused(self):
        self.whole("d", *SMALL)
        path = self.folder / "d" / "manifest.json"
        path.write_text(path.read_text().replace("map-000", "map-0O0"))
        before = self.hashes("d")
        for flags in ([], ["--resume"]):
            self.fails(2, self.bake("d", *SMALL, *flags), "d/manifest.json", "damaged", "another folder")
            self.assertNotIn("bake the scene again", self.bake("d", *SMALL, *flags).stderr)
        self.assertEqual(self.hashes("d"), before)

    def test_a_finished_bake_leaves_an_unfinished_one_of_other_settings(self):
        plain = self.whole("d", *SMALL)
        other = ["--density", "41", *SMALL[2:]]
        self.ok(self.bake("d", *other, "--shard", "1/2"))
        self.assertIn("nothing is left to do", self.ok(self.bake("d", *SMALL, "--resume")).stderr)
        self.assertEqual(set(self.hashes("d")), {*plain, "work/bake.json", "work/shard-1-of-2.log"})
        # Nor what cannot be told whose it is.
        order = self.folder / "d" / "work" / "bake.json"
        sound = order.read_bytes()
        for damaged in (b"", sound.replace(b"bake/1", b"bake/0"), None):
            order.write_bytes(damaged) if damaged is not None else order.unlink()
            before = self.hashes("d")
            self.assertIn("nothing is left to do", self.ok(self.bake("d", *SMALL, "--resume")).stderr)
            self.assertEqual(self.hashes("d"), before)
        order.write_bytes(sound)
        # Ctrl-C while it plans: --resume would not go on with what is there.
        self.assertEqual(self.end("d", signal.SIGINT, lambda: True, *LONG), 130)
        self.assertIn("error: cancelled; nothing was written\n", self.said)
        self.assertEqual(order.read_bytes(), sound)
        self.ok(self.bake("d", *other, "--shard", "2/2"))
        self.ok(self.lucerna("lightmap", "merge", "d"))
        self.assertEqual(self.hashes("d"), self.whole("plain", *other))

    def limited(self, bytes_):
        return {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (bytes_, bytes_))}

    def test_a_full_disk_is_one_message_and_loses_nothing(self):
        plain = self.whole("plain", *SMALL)
        largest = max(path.stat().st_size for path in (self.folder / "plain").iterdir())
        # The log does not fit.
        self.fails(1, self.bake("log", *SMALL, **self.limited(3000)), "cannot be written", "--resume")
        self.ok(self.bake("log", *SMALL, "--resume"))
        self.assertEqual(self.hashes("log"), plain)
        # The largest file of the lightmap does not.
        for shard in (1, 2):
            self.ok(self.bake("map", *SMALL, "--shard", f"{shard}/2"))
        self.fails(1, self.lucerna("lightmap", "merge", "map", **self.limited(largest - 1)), "writing failed")
        self.assertFalse((self.folder / "map" / "manifest.json").exists())
        self.assertEqual([path.name for path in (self.folder / "map").iterdir() if path.name.startswith(".")], [])
        self.ok(self.lucerna("lightmap", "merge", "map"))
        self.assertEqual(self.hashes("map"), plain)

    # Scenes and settings

    def test_unknown_groups_are_named_and_nothing_is_made(self):
        self.fails(2, self.bake("g", *SMALL, "--lights", "always-on, kitchen"), "no light group 'kitchen'", "always-on")
        self.assertFalse((self.folder / "g").exists())

    def test_no_lights_is_a_warning(self):
        (self.folder / "plain.obj").write_text("v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3 4\n")
        (self.folder / "dark.json").write_text(json.dumps(
            {"lucerna": "scene/1", "include": [{"file": "plain.obj"}], "ambient": [0.1, 0.1, 0.1]}))
        run = self.ok(self.bake("dark", *SMALL, scene="dark.json"))
        self.assertIn("no lights to bake", run.stderr)
        table = json.loads(self.ok(self.lucerna("lightmap", "inspect", "dark", "--json")).stdout)
        self.assertEqual([each["irradiance"]["max"] for each in table["maps"]], [0] * len(table["maps"]))

    def test_what_the_scene_says_of_baking_counts_unless_flags_say_otherwise(self):
        (self.folder / "floor.obj").write_text("v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3 4\n")

        def scene(name, **bake):
            (self.folder / name).write_text(json.dumps(
                {"lucerna": "scene/1", "include": [{"file": "floor.obj"}], "bake": bake, "lights": [
                    {"name": "a", "kind": "point", "intensity": 3, "position": [0, 1, 0]},
                    {"name": "b", "kind": "point", "intensity": 3, "position": [0.5, 1, 0], "group": "desk"}]}))
            return name
        flags = ["--density", "40", "--preset", "preview"]
        hinted = scene("hinted.json", mapSize=256, patchTolerance=0.25)
        self.ok(self.bake("a", *flags, scene=hinted))
        coarse = self.manifest("a")
        self.assertEqual(coarse["side"], 256)
        self.assertEqual(faults(coarse, schema()), [])
        self.ok(self.bake("b", *flags, "--size", "128", "--patch-tolerance", "0.0001", scene=hinted))
        fine = self.manifest("b")
        self.assertEqual(fine["side"], 128)
        self.assertLess(coarse["patches"][0]["bytes"], fine["patches"][0]["bytes"])
        self.ok(self.bake("c", *flags, "--shard", "1/2", scene=hinted))
        self.fails(2, self.bake("c", *flags, "--shard", "2/2", "--patch-tolerance", "0.1", scene=hinted),
                   "--patch-tolerance is 0.25 there, 0.1 here")
        self.ok(self.bake("c", *flags, "--shard", "2/2", scene=hinted))
        self.ok(self.lucerna("lightmap", "merge", "c"))
        self.assertEqual(self.hashes("c"), self.hashes("a"))
        lit = scene("lit.json", patches=False)
        self.ok(self.bake("d", *flags, scene=lit))
        self.assertEqual(self.manifest("d")["patches"], [])
        self.ok(self.bake("e", *flags, "--lights", "all", scene=lit))
        self.assertEqual(len(self.manifest("e")["patches"]), 1)
        self.fails(2, self.bake("f", *flags, scene=scene("dark.json", maps=False, patches=False)), "nothing to bake")

    def test_too_many_maps_say_what_fits(self):
        for most, density in ((2, 200), (2, 20000), (1, 77), (9, 93)):
            flags = ["--size", "64", "--most-maps", most, "--preset", "preview"]
            run = self.bake("many", "--density", density, *flags)
            self.assertEqual(run.returncode, 2, run.stderr)
            said = re.search(rf"error: \d+ charts need about (\d+) maps of 64 x 64 texels, and --most-maps allows "
                             rf"{most}; wanted --density ([\d.]+), which fits, or larger maps \(--size\) or more of "
                             r"them \(--most-maps\)\n", run.stderr)
            self.assertTrue(said, run.stderr)
            self.assertGreater(int(said[1]), most)
            self.assertFalse((self.folder / "many").exists())
            self.ok(self.bake("many", "--density", said[2], *flags, "--resume"))
            shutil.rmtree(self.folder / "many")
            self.assertEqual(self.bake("more", "--density", 1.25 * float(said[2]), *flags).returncode, 2)
        # No density makes the gap between twelve charts small enough.
        run = self.bake("none", "--size", 16, "--padding", 16, "--most-maps", 1)
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertIn("and --most-maps allows 1; wanted larger maps (--size) or more of them", run.stderr)

    # Looking

    def test_a_dry_run_says_all_and_writes_nothing(self):
        (self.folder / "odd.obj").write_text(
            "v 0 0 0\nv 4 0 0\nv 0 0 -4\nv nan 0 0\nv 8 0 0\nf 1 2 3\nf 2 3 1\nf 1 2 5\n")
        before = sorted(os.listdir(self.folder))
        run = self.ok(self.lucerna("bake", "odd.obj", "--density", "10", "--dry-run", "--json"))
        document = json.loads(run.stdout)
        self.assertEqual(document["found"]["duplicate"], 1)
        self.assertEqual(document["found"]["degenerate"], 1)
        document = json.loads(self.ok(self.bake("d", *LONG, "--dry-run", "--json")).stdout)
        self.assertGreater(document["estimate"]["light_seconds"], 0)
        self.assertGreater(document["estimate"]["log_bytes"], 0)
        self.assertEqual(document["found"]["lights_inside"], [])
        text = self.ok(self.bake("d", *SMALL, "--dry-run")).stdout
        for word in ("charts", "texels", "maps", "estimate", "memory"):
            self.assertIn(word, text)
        self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_texels_are_those_that_charts_cover(self):
        """The same in a dry run, while baking and in the manifest; the box hides none."""
        scene = "builtin:cornell?boxes=0"
        covered = json.loads(self.ok(self.bake("t", *SMALL, "--dry-run", "--json", scene=scene)).stdout)["texels"]
        text = self.ok(self.bake("t", *SMALL, "--dry-run", scene=scene)).stdout
        self.assertIn(f"texels     {covered} that they cover\n", text)
        run = self.ok(self.bake("t", *SMALL, "--json", scene=scene))
        self.assertIn(f"which cover {covered} texels of ", run.stderr)
        self.assertEqual(json.loads(run.stdout)["texels"], covered)
        self.assertEqual(sum(each["texels"] for each in self.manifest("t")["maps"]), covered)

    def test_odd_triangles_are_left_out(self):
        """No numbers, no area, and far too large: the rest is lit as without them, in shadow too."""
        plain = "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3 4\nv 0 1 0\nv 1 1 0\nv 0 1 -1\nf 5 7 6\nf 5 6 7\n"
        odd = "v nan 2 0\nv 1e30 2 0\nv -1e30 2 1e30\nv 1 2 0\nf 5 6 8\nf 5 6 9\nf 8 9 10\nf 6 6 7\nf 5 9 10\n"
        looks = []
        for name, text in (("plain", plain), ("odd", plain + odd)):
            (self.folder / f"{name}.obj").write_text(text)
            (self.folder / f"{name}.json").write_text(json.dumps(
                {"lucerna": "scene/1", "include": [{"file": f"{name}.obj"}],
                 "lights": [{"kind": "directional", "intensity": 3, "direction": [0, -1, 0]}]}))
            run = self.ok(self.bake(name, *SMALL, scene=f"{name}.json"))
            looks.append(json.loads(self.ok(self.lucerna("lightmap", "inspect", name, "--json")).stdout)["maps"])
        self.assertIn("2 triangles are too large", run.stderr)
        self.assertIn("1 triangles have no area and get no light\n", run.stderr)
        self.assertEqual([each["irradiance"] for each in looks[0]], [each["irradiance"] for each in looks[1]])
        self.assertEqual([each["unsound"] for each in looks[1]], [0] * len(looks[1]))
        self.assertEqual(looks[1][0]["irradiance"]["min"], 0)

    def test_a_light_inside_a_solid_is_found(self):
        corners = [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
        sides = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"]
        (self.folder / "box.obj").write_text(
            "".join(f"v {x} {y} {z}\n" for x, y, z in corners) + "".join(f"f {side}\n" for side in sides))
        (self.folder / "lamps.json").write_text(json.dumps(
            {"lucerna": "scene/1", "include": [{"file": "box.obj"}],
             "materials": {"default": {"doubleSided": False}},
             "lights": [{"name": "inside", "kind": "point", "intensity": 1, "position": [0.1, 0.2, 0]},
                        {"name": "outside", "kind": "point", "intensity": 1, "position": [0, 3, 0]}]}))
        found = json.loads(self.ok(self.lucerna("bake", "lamps.json", "--dry-run", "--json")).stdout)["found"]
        self.assertEqual(found["lights_inside"], ["inside"])

    def test_inspect_draws_every_map(self):
        self.whole("p", *SMALL)
        manifest = self.manifest("p")
        run = self.ok(self.lucerna("lightmap", "inspect", "p", "-o", "look", "--scene", SCENE, "--json"))
        table = json.loads(run.stdout)
        self.assertEqual(len(table["maps"]), len(manifest["maps"]))
        for each, entry in zip(table["maps"], manifest["maps"]):
            self.assertEqual(each["overlaps"], 0)
            self.assertEqual(each["unsound"], 0)
            # Those inside of solids are not in the manifest's.
            self.assertGreaterEqual(each["texels"], entry["texels"])
            self.assertLess(each["texels"], 1.2 * entry["texels"])
            self.assertLessEqual(each["irradiance"]["max"], max(entry["largest"]))
            self.assertAlmostEqual(each["density"]["min"], 40, delta=1)
            self.assertAlmostEqual(each["density"]["max"], 40, delta=1)
            self.assertEqual(each["bytes"], (self.folder / "p" / each["file"]).stat().st_size)
        wanted = {f"{what}-{number:03}.png" for what in ("light", "charts", "validity", "seams", "density")
                  for number in range(len(manifest["maps"]))}
        self.assertEqual(set(os.listdir(self.folder / "look")), wanted)
        for name in wanted:
            size = struct.unpack(">II", (self.folder / "look" / name).read_bytes()[16:24])
            self.assertEqual(size, (manifest["side"],) * 2)
        self.assertIn("map-000.exr", self.ok(self.lucerna("lightmap", "inspect", "p")).stdout)

    def test_groups_and_copies_are_drawn_and_checked(self):
        (self.folder / "floor.obj").write_text("v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3 4\n")
        (self.folder / "lamps.json").write_text(json.dumps(
            {"lucerna": "scene/1", "include": [{"file": "floor.obj"}],
             "lights": [{"name": "a", "kind": "point", "intensity": 100, "position": [0, 1, 0]},
                        {"name": "b", "kind": "point", "intensity": 100, "position": [0.5, 1, 0], "group": "desk"}]}))
        flags = [*SMALL, "--encode", "bc6h,png"]
        self.ok(self.bake("plain", *flags, scene="lamps.json"))
        self.ok(self.bake("parts", *flags, "--shard", "1/2", scene="lamps.json"))
        self.fails(2, self.bake("parts", *SMALL, "--shard", "2/2", scene="lamps.json"), "encode", "none here")
        self.ok(self.bake("parts", *flags, "--shard", "2/2", scene="lamps.json"))
        self.ok(self.lucerna("lightmap", "merge", "parts"))
        self.assertEqual(self.hashes("parts"), self.hashes("plain"))
        self.assertEqual(faults(self.manifest("plain"), schema()), [])
        table = json.loads(self.ok(self.lucerna("lightmap", "inspect", "plain", "-o", "look", "--json")).stdout)
        self.assertEqual([each["group"] for each in table["patches"]], ["desk"])
        self.assertTrue((self.folder / "look" / "patch-000-000.png").exists())
        self.assertGreater(table["maps"][0]["bytes"], (self.folder / "plain" / "map-000.exr").stat().st_size)
        for name in ("map-000.bc6h.ktx2", "patch-000.bin"):
            path = self.folder / "plain" / name
            sound = path.read_bytes()
            path.write_bytes(sound[:-1] + bytes([sound[-1] ^ 1]))
            self.fails(3, self.lucerna("lightmap", "inspect", "plain"), name, "damaged")
            path.write_bytes(sound)

    def test_damaged_lightmaps_are_never_used(self):
        self.whole("q", *SMALL)
        chance = random.Random(3)
        for name in sorted(self.hashes("q")):
            path = self.folder / "q" / name
            sound = path.read_bytes()
            for _ in range(20 if name == "manifest.json" else 3):
                at = chance.randrange(len(sound))
                if sound[at:at + 1].isspace():
                    continue  # of JSON, that says nothing
                flipped = sound[:at] + bytes([sound[at] ^ 1 << chance.randrange(8)]) + sound[at + 1:]
                for damaged in (flipped, sound[:at] + sound[at + 1:], sound[:at]):
                    path.write_bytes(damaged)
                    run = self.lucerna("lightmap", "inspect", "q")
                    self.assertEqual(run.returncode, 3, f"{name}, byte {at}: {run.stderr}{run.stdout}")
                    self.assertIn(name, run.stderr)
                    self.assertEqual(run.stdout, "")
            path.unlink()
            self.fails(3, self.lucerna("lightmap", "inspect", "q"), name)
            path.write_bytes(sound)
        self.ok(self.lucerna("lightmap", "inspect", "q"))

    def test_the_manifest_is_as_its_schema_says(self):
        self.whole("s", *SMALL)
        manifest, whole = self.manifest("s"), schema()
        self.assertEqual(faults(manifest, whole), [])
        self.assertEqual(faults({**manifest, "colour": 1}, whole), ["manifest: colour is unknown"])
        self.assertEqual(faults({**manifest, "side": "1"}, whole), ["manifest/side: is no integer"])
        page = (DOCS / "lightmaps.md").read_text()
        for key in [*whole["properties"], *whole["properties"]["settings"]["properties"]]:
            self.assertIn(f"`{key}`", page)


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
