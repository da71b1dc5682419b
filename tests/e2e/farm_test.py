#!/usr/bin/env python3
"""The commands of docs/user/bake-farm.md, run as they stand there on a scene of the tests: a shard is killed and goes
on, and the lightmap is, byte for byte, what one process bakes. Slurm runs as a cluster of this machine alone.

Usage: farm_test.py PROGRAM [unittest arguments]
"""
import contextlib
import hashlib
import json
import os
import pathlib
import pwd
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = ""
SCENE = "builtin:cornell"
FLAGS = "--density 400 --size 1024 --preset standard"  # a second or two of light
SMALL = "--density 40 --size 128 --preset preview"
ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "user" / "bake-farm.md").read_text()
LIMIT = 120  # seconds that anything may take
CONF = """\
ClusterName=farm
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/none
AuthInfo=cred_expire=5
CredType=cred/none
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SchedulerParameters=batch_sched_delay=0,sched_interval=1
NodeName={host} NodeAddr=127.0.0.1 CPUs=16
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def commands(start, end):
    """The indented lines of the page from the first that starts so to the next that ends so."""
    found = re.search(rf"^    {re.escape(start)}.*?{re.escape(end)}$", PAGE, re.MULTILINE | re.DOTALL)
    return "\n".join(line.removeprefix("    ") for line in found[0].split("\n"))


def within(limit, reached, pause=0.001):
    """Waits until reached() is something, and gives it; None if that takes more seconds."""
    deadline = time.monotonic() + limit
    while time.monotonic() < deadline:
        if found := reached():
            return found
        time.sleep(pause)
    return None


def free_ports(count):
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for each in sockets:
            each.bind(("127.0.0.1", 0))
        return [each.getsockname()[1] for each in sockets]


def hashes(root):
    """Of every file in it, by name."""
    return {str(path.relative_to(root)): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted(root.rglob("*")) if path.is_file()}


class FarmTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory(prefix="lucerna-farm-") as folder:
            plain = pathlib.Path(folder) / "plain"
            subprocess.run([PROGRAM, "bake", SCENE, "-o", plain, *FLAGS.split()], check=True, timeout=LIMIT,
                           stderr=subprocess.DEVNULL)
            cls.plain = hashes(plain)

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lucerna-farm-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "bin").mkdir()
        (self.folder / "bin" / "lucerna").symlink_to(PROGRAM)
        self.environment = {**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}:/usr/sbin"}

    def need(self, *programs):
        for program in programs:
            if not shutil.which(program, path=self.environment["PATH"]):
                self.skipTest(f"{program} is not installed")

    def start(self, script, flags=FLAGS):
        script = script.replace("street.gltf", f"{SCENE} {flags}")
        return subprocess.Popen(["bash", "-euo", "pipefail", "-c", script], cwd=self.folder, env=self.environment,
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def ok(self, process):
        output, said = process.communicate(timeout=LIMIT)
        self.assertEqual(process.returncode, 0, output + said)
        return output

    def is_as_plain(self, folder):
        self.assertIn("manifest.json", self.plain)
        self.assertEqual(hashes(self.folder / folder), self.plain)

    def process(self, shard):
        """The number of the process that bakes it, if there is one."""
        for entry in pathlib.Path("/proc").glob("[0-9]*"):
            with contextlib.suppress(OSError):
                words = (entry / "cmdline").read_bytes().split(b"\0")
                if words[1:2] == [b"bake"] and shard.encode() in words and (entry / "cwd").samefile(self.folder):
                    return int(entry.name)
        return None

    def kill(self, shard):
        """Ends that shard without a word once some of its light is in its log, and gives its number."""
        log = self.folder / "street.bake" / "work" / f"shard-{shard.replace('/', '-of-')}.log"
        process = within(LIMIT, lambda: self.process(shard))
        self.assertTrue(process, f"shard {shard} does not begin")
        self.assertTrue(within(LIMIT, lambda: log.exists() and log.stat().st_size > 1 << 16))
        os.kill(process, signal.SIGKILL)
        return process

    def test_gnu_parallel(self):
        self.need("parallel")
        if "GNU" not in self.ok(self.start("parallel --version")):
            self.skipTest("parallel is another program than GNU parallel")
        bake, merge = commands("parallel", "merge street.bake").split("\n")
        running = self.start(bake)
        killed = self.kill("3/8")
        self.assertTrue(within(LIMIT, lambda: self.process("3/8") not in (None, killed)), "there is no second try")
        self.ok(running)
        self.ok(self.start(merge))
        self.is_as_plain("street.bake")

    def test_xargs(self):
        self.ok(self.start(commands("seq", "--resume")))
        self.ok(self.start("lucerna lightmap merge street.bake"))
        self.is_as_plain("street.bake")

    def test_merge_says_what_is_missing_as_on_the_page(self):
        for shard in (1, 2, 4, 5, 6, 7, 8):
            self.ok(self.start(f"lucerna bake street.gltf -o street.bake --shard {shard}/8", SMALL))
        merge = self.start("lucerna lightmap merge street.bake")
        said = merge.communicate(timeout=LIMIT)[1]
        self.assertEqual(merge.returncode, 1, said)
        numbers = re.compile(r"\d+ of \d+ units")
        self.assertEqual(numbers.sub("", said.strip()), numbers.sub("", commands("error:", "--resume")))

    def test_another_kind_of_processor_is_refused(self):
        self.ok(self.start("lucerna bake street.gltf -o street.bake --shard 1/2", SMALL))
        order = self.folder / "street.bake" / "work" / "bake.json"
        document = json.loads(order.read_text())
        order.write_text(json.dumps({**document, "processor": "sse9"}))
        for command in ("bake street.gltf -o street.bake --shard 2/2", "lightmap merge street.bake"):
            running = self.start(f"lucerna {command}", SMALL)
            said = running.communicate(timeout=LIMIT)[1]
            self.assertEqual(running.returncode, 2, said)
            self.assertIn(f"of processors with sse9, this one has {document['processor']}", said)

    # Slurm

    def cluster(self):
        """A controller and a node, until the test ends; skips the test where they do not start."""
        self.need("slurmctld", "slurmd", "sbatch", "scontrol", "squeue")
        host = socket.gethostname().split(".")[0]
        try:
            user = pwd.getpwuid(os.getuid()).pw_name
        except KeyError:
            self.skipTest("Slurm wants a user that has a name")
        controller, node = free_ports(2)
        for name in ("state", "spool"):
            (self.folder / "slurm" / name).mkdir(parents=True)
        conf = self.folder / "slurm" / "slurm.conf"
        conf.write_text(CONF.format(host=host, controller=controller, node=node, user=user,
                                    folder=conf.parent))
        self.environment["SLURM_CONF"] = str(conf)
        daemons = {name: self.daemon(name) for name in ("slurmctld", "slurmd")}

        def settled():
            ended = [name for name, process in daemons.items() if process.poll() is not None]
            state = subprocess.run(["sinfo", "-h", "-o", "%t"], env=self.environment, capture_output=True, text=True,
                                   check=False).stdout.strip()
            return ended or state == "idle"
        if within(20, settled, 0.1) is not True:
            said = "\n".join((conf.parent / f"{name}.txt").read_text()[-1000:] for name in daemons)
            self.skipTest(f"Slurm's daemons do not start here:\n{said}")

    def daemon(self, name):
        with (self.folder / "slurm" / f"{name}.txt").open("w") as output:
            process = subprocess.Popen([name, "-D"], env=self.environment, cwd=self.folder, stdin=subprocess.DEVNULL,
                                       stdout=output, stderr=output)

        def stop():
            process.terminate()
            try:
                process.wait(timeout=20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self.addCleanup(stop)
        return process

    def slurm(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, timeout=LIMIT,
                              check=True).stdout

    def submit(self, flags):
        """As on the page, and gives the number of the array."""
        lines = commands("export SCENE", 'merge $BAKE"').replace("examples/", f"{ROOT}/examples/")
        lines = re.sub('FLAGS=".*"', f'FLAGS="{flags}"', lines.replace("street.gltf", SCENE))
        return int(self.ok(self.start(lines + "\necho $job")).split()[-1])

    def wait(self):
        """Until no job is left."""
        self.assertTrue(within(LIMIT, lambda: not self.slurm("squeue", "-h"), 0.1),
                        self.slurm("squeue") + "".join(path.read_text() for path in self.folder.glob("*.*t")))

    def job(self, name):
        return self.slurm("scontrol", "show", "job", str(name))

    def test_slurm(self):
        self.cluster()
        job = self.submit(FLAGS)
        self.kill("3/8")
        self.wait()
        self.assertIn("exit code 137, queued again", (self.folder / f"bake-{job}_3.txt").read_text())
        self.assertIn("Restarts=1", self.job(f"{job}_3"))
        self.assertIn("Restarts=0", self.job(f"{job}_4"))
        self.is_as_plain("street.bake")

        faulty = self.submit("--density 0")  # is not tried again, and nothing is merged
        self.wait()
        shard, merge = self.job(f"{faulty}_1"), self.job(faulty + 1)
        self.assertIn("Restarts=0", shard)
        self.assertIn("ExitCode=2:0", shard)
        self.assertIn("JobState=CANCELLED", merge)


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
