#!/usr/bin/env python3
"""tools/new_pass in a copy of the tree, and what docs/dev/adding_a_pass.md does next: what it makes compiles, is
registered, draws, and passes all tests of passes.

Where the page says ./dev build, only the objects are built that the new pass changes; the rest is linked from this
build.
Usage: new_pass_test.py SOURCE_DIR BINARY_DIR COMPILER [unittest arguments]
"""
import pathlib
import shlex
import shutil
import subprocess

import outside
from outside import BUILD, SOURCE, commands

COPY = BUILD / "new_pass"  # always the same, so that a compiler cache helps
MADE = COPY / "build" / "release"
NAME, FOLDER = "SlateGrey", "slate_grey"
OBJECTS = [f"src/passes/CMakeFiles/lucerna_passes.dir/{FOLDER}/{FOLDER}.cpp.o",
           "src/passes/CMakeFiles/lucerna_passes.dir/register_passes.cpp.o",
           "src/passes/CMakeFiles/lucerna_passes.dir/passes_shaders.cpp.o"]
TESTS = [f"src/passes/CMakeFiles/passes_gl_test.dir/{FOLDER}/{FOLDER}_gl_test.cpp.o",
         "src/passes/CMakeFiles/passes_gl_test.dir/passes_gl_test.cpp.o"]


def contents(folder):
    return {path: path.read_bytes() for path in sorted(folder.rglob("*"))
            if path.is_file() and not {"build", ".git"} & set(path.relative_to(folder).parts)}


class NewPassTest(outside.OutsideTest):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(COPY, ignore_errors=True)
        tracked = subprocess.run(["git", "-C", SOURCE, "ls-files", "-co", "--exclude-standard"],
                                 capture_output=True, text=True, check=True).stdout.splitlines()
        for name in tracked:
            if (SOURCE / name).is_file():
                (COPY / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(SOURCE / name, COPY / name)
        subprocess.run(["git", "init", "-q", COPY], check=True)  # tools ask git for the tree's files

    def link(self, program, objects, drop=""):
        """Links `program` of this build anew as one of the copy's, with the copy's objects before all else."""
        commands = self.succeed("ninja", "-C", BUILD, "-t", "commands", f"bin/{program}").splitlines()
        words = shlex.split(commands[-1].removeprefix(": && ").removesuffix(" && :"))
        words = [word for word in words if not (drop and drop in word)]
        at = words.index("-o")
        words[at + 1] = MADE / "bin" / program
        words[at:at] = [MADE / name for name in objects]
        self.succeed(*words, cwd=BUILD)

    def test_bad_and_taken_names_leave_the_tree_as_it_was(self):
        before = contents(COPY)
        for name, wanted in (("slate_grey", "UpperCamel"), ("", "UpperCamel"), ("../Slate", "UpperCamel"),
                             ("ToneMap", "src/passes/tone_map/tone_map.cpp"), ("Cull", "already")):
            run = self.run_command(COPY / "tools" / "new_pass", name)
            self.assertEqual(run.returncode, 2)
            self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
            self.assertIn(wanted, run.stderr)
        self.assertEqual(contents(COPY), before)

    def follow(self, command):
        return self.succeed("bash", "-ec", command, cwd=COPY)

    def build(self):
        self.follow("cmake --preset release")
        self.succeed("ninja", "-C", MADE, *OBJECTS, *TESTS)
        (MADE / "bin").mkdir(exist_ok=True)
        self.link("passes_test", OBJECTS)
        self.link("passes_gl_test", OBJECTS + TESTS, drop="/passes_gl_test.cpp.o")
        self.link("lucerna", OBJECTS)

    def test_the_page_of_a_pass_of_lucerna(self):
        page = commands("A pass of Lucerna").replace("FilmGrain", NAME).replace("film_grain", FOLDER).splitlines()
        make, build, *rest = page
        printed = self.follow(make)
        self.assertEqual(printed.partition("next:\n")[2].split("\n"), [f"  {step}" for step in (build, *rest)] + [""])
        self.assertEqual(self.run_command(COPY / "tools" / "new_pass", NAME).returncode, 2)
        self.assertEqual(build, "./dev build")
        self.build()
        for command in rest:
            self.follow(command)

        run = self.succeed(MADE / "bin" / "passes_gl_test", f"--gtest_filter={NAME}.*:*/{NAME}")
        self.assertIn("[  PASSED  ] 4 tests", run)
        program, figure = MADE / "bin" / "lucerna", COPY / "src" / "passes" / FOLDER / f"{FOLDER}.js"
        self.assert_whole_deferred_picture(program, figure)
        self.assert_joins_in_tiles(MADE, program, "--pipeline", figure)


if __name__ == "__main__":
    outside.main()
