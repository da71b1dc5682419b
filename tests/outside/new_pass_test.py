#!/usr/bin/env python3
"""tools/new_pass in a copy of the tree: what it makes compiles, is registered, draws, and passes its test.

Of the copy only the objects are built that the new pass changes; the rest is linked from this build.
Usage: new_pass_test.py SOURCE_DIR BINARY_DIR COMPILER [unittest arguments]
"""
import pathlib
import shlex
import shutil
import subprocess

import outside
from outside import BUILD, SOURCE

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
        return MADE / "bin" / program

    def test_bad_and_taken_names_leave_the_tree_as_it_was(self):
        before = contents(COPY)
        for name, wanted in (("slate_grey", "UpperCamel"), ("", "UpperCamel"), ("../Slate", "UpperCamel"),
                             ("ToneMap", "src/passes/tone_map/tone_map.cpp"), ("Cull", "already")):
            run = self.run_command(COPY / "tools" / "new_pass", name)
            self.assertEqual(run.returncode, 2)
            self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
            self.assertIn(wanted, run.stderr)
        self.assertEqual(contents(COPY), before)

    def test_what_it_makes_works(self):
        self.succeed(COPY / "tools" / "new_pass", NAME)
        self.assertEqual(self.run_command(COPY / "tools" / "new_pass", NAME).returncode, 2)
        self.succeed("cmake", "--preset", "release", cwd=COPY)
        self.succeed("ninja", "-C", MADE, *OBJECTS, *TESTS)
        (MADE / "bin").mkdir(exist_ok=True)

        test = self.link("passes_gl_test", OBJECTS + TESTS, drop="passes_gl_test.dir/")
        run = self.succeed(test, f"--gtest_filter={NAME}.*:*/{NAME}")
        self.assertIn("[  PASSED  ] 4 tests", run)

        program = self.link("lucerna", OBJECTS)
        self.succeed(COPY / "tools" / "pass_pages", "--check", "--lucerna", program)
        self.succeed(COPY / "tools" / "make_figures", f"src/passes/{FOLDER}/README.md", cwd=COPY)
        figure = COPY / "src" / "passes" / FOLDER / f"{FOLDER}.js"
        self.assert_whole_deferred_picture(program, figure)
        self.assert_joins_in_tiles(MADE, program, "--pipeline", figure)
        for check in ("check_links", "check_layers", "check_shaders"):
            self.succeed(COPY / "tools" / check, COPY)


if __name__ == "__main__":
    outside.main()
