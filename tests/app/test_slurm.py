# SPDX-License-Identifier: Apache-2.0
"""Runs and ensembles as jobs of Slurm: the scripts, run here task by task, give what the same gives here. And the plot of
a sweep."""
import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from program import PROGRAM, ProgramTest, bits

VARIED = ("--members", 2, "--vary", "slope.angle=30 deg,50 deg")
SBATCH = """#!/bin/bash
# In place of sbatch: keeps what it is given, answers as one of a cluster of several does.
echo "$@" >> "$SUBMITTED"
echo "1$(wc -l < "$SUBMITTED");cluster"
"""


class Slurm(ProgramTest):
    def launch(self, *arguments, status=0, sbatch=SBATCH, command="ensemble"):
        """With a fake sbatch, or none."""
        tools = self.folder / "tools"
        shutil.rmtree(tools, ignore_errors=True)
        tools.mkdir()
        for program in (shutil.which("bash"), shutil.which("wc"), "/usr/bin/python3"):
            (tools / Path(program).name).symlink_to(program)
        if sbatch:
            (tools / "sbatch").write_text(sbatch)
            (tools / "sbatch").chmod(0o755)
        environment = {**os.environ, "PATH": str(tools), "SUBMITTED": str(self.folder / "submitted")}
        return self.talus(command, "case.toml", "--launch", "slurm", *arguments, status=status, env=environment)

    def run_task(self, script, task):
        """What Slurm does with a task."""
        return subprocess.run(["bash", script], env={**os.environ, "SLURM_ARRAY_TASK_ID": str(task)}, cwd="/",
                              capture_output=True, text=True, check=False)

    def test_the_tasks_and_what_gathers_them_give_the_ensemble(self):
        name = "it's 100% here"
        said = self.launch("--out", name, *VARIED, "--slurm=--time=1:00:00", "--slurm=-p short").stdout
        self.assertIn("Submitted 4 runs: members: job 11; gathered by job 12", said)
        slurm = self.folder / name / "slurm"
        first, second = (self.folder / "submitted").read_text().splitlines()
        self.assertEqual(first, f"--parsable {slurm}/members.sh")
        self.assertEqual(second, f"--parsable --dependency=afterany:11 {slurm}/gather.sh")
        for script in slurm.glob("*.sh"):
            subprocess.run(["bash", "-n", script], check=True)
        text = (slurm / "members.sh").read_text()
        directives = re.findall(r"^#SBATCH (.*)", text, re.M)
        for wanted in ("--array=0-3", "--cpus-per-task=1", "--time=1:00:00", "-p short"):
            self.assertIn(wanted, directives)
        self.assertIn(f'--output="{slurm}/tasks.out"'.replace("%", "%%"), directives)
        self.assertLess(text.rindex("#SBATCH"), text.index("\ncd "), "sbatch reads no directive after a command")

        for task in (2, 0, 3):
            self.assertEqual(self.run_task(slurm / "members.sh", task).returncode, 0)
        self.assertEqual(self.run_task(slurm / "members.sh", 4).returncode, 2)
        partly = self.run_task(slurm / "gather.sh", "")
        self.assertEqual(partly.returncode, 3)
        self.assertIn("3 of 4 runs done", partly.stdout)
        self.assertIn("Not done: ", partly.stdout)
        # What is launched again is only what is not done.
        self.launch("--out", name, *VARIED, "--resume", "--jobs", 5)
        self.assertIn("#SBATCH --array=0-0%5\n", (slurm / "members.sh").read_text())
        self.assertEqual(self.run_task(slurm / "members.sh", 0).returncode, 0)
        self.assertEqual(self.run_task(slurm / "gather.sh", "").returncode, 0)
        self.assertIn("are done already", self.launch("--out", name, *VARIED, "--resume").stdout)

        self.talus("ensemble", "case.toml", "--out", "here", *VARIED)
        for path in ("sweep.csv", "sweep.json", "angle=30deg/members.csv", "angle=50deg/quantities.csv"):
            self.assertEqual((self.folder / name / path).read_bytes(), (self.folder / "here" / path).read_bytes(), path)
        for member in (self.folder / "here").glob("*/seed_????"):
            self.assertEqual(bits(member), bits(self.folder / name / member.relative_to(self.folder / "here")))
        self.assertEqual(list((self.folder / name).glob("*/*.out")), sorted(slurm.glob("*.out")))

    def test_a_run_as_a_job_that_goes_on_when_it_begins_again(self):
        said = self.launch("--out", "it's 100%", "--nodes", 1, "--threads", 1, "--set", "output.pictures=false",
                           "--slurm=--time=1:00:00", command="run").stdout
        self.assertIn("Submitted a run on 1 node: 11", said)
        script = self.folder / "it's 100%-slurm/job.sh"
        self.assertEqual((self.folder / "submitted").read_text(), f"--parsable {script}\n")
        directives = re.findall(r"^#SBATCH (.*)", script.read_text(), re.M)
        for wanted in ("--nodes=1", "--ntasks-per-node=1", "--signal=USR1@120", "--time=1:00:00"):
            self.assertIn(wanted, directives)
        # In place of srun, which starts the processes.
        srun = self.folder / "tools/srun"
        srun.write_text('#!/bin/bash\n[[ $1 == --cpu-bind=none ]] && shift\nexec "$@"\n')
        srun.chmod(0o755)
        environment = {**os.environ, "PATH": f"{srun.parent}:{os.environ['PATH']}"}
        for _ in range(2):
            done = subprocess.run(["bash", script], env=environment, cwd="/", capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("resumed", (self.folder / "it's 100%/log.txt").read_text())
        self.talus("run", "case.toml", "--out", "here", "--threads", 1)
        self.assertEqual(bits(self.folder / "here"), bits(self.folder / "it's 100%"))
        self.assertIn("is there already", self.launch("--out", "here", status=2, command="run").stderr)

    def test_a_run_that_cannot_be_is_refused_before_it_waits(self):
        said = self.launch("--out", "r", "--nodes", 5000, command="run", status=2).stderr
        self.assertIn("grains for 5000 processes", said)
        said = self.launch("--out", "r", "--set", "particles.count=-1", "--set", "run.end=-1 s", command="run", status=2)
        self.assertIn("2 problems", said.stderr)
        self.assertFalse((self.folder / "submitted").exists())

    def test_a_task_that_begins_again_resumes(self):
        self.launch("--out", "e", "--members", 1)
        script = self.folder / "e/slurm/members.sh"
        self.assertEqual(self.run_task(script, 0).returncode, 0)
        self.assertEqual(self.run_task(script, 0).returncode, 0)
        self.assertIn("resumed", (self.folder / "e/all/seed_0003/log.txt").read_text())

    def test_a_member_that_fails_is_told_with_its_reason(self):
        self.launch("--out", "e", "--members", 1, "--vary", "contact.stiffness=10 N/m,1 mN/m")
        for task, status in ((0, 0), (1, 3)):
            self.assertEqual(self.run_task(self.folder / "e/slurm/members.sh", task).returncode, status)
        said = self.run_task(self.folder / "e/slurm/gather.sh", "")
        self.assertEqual(said.returncode, 3)
        self.assertRegex(said.stdout, r"Not done: e/stiffness=1mNm/seed_0003: talus: .*overlap")

    def test_without_sbatch_the_scripts_are_there_to_be_submitted(self):
        said = self.launch("--out", "e", "--members", 1, sbatch=None).stdout
        self.assertIn(f"bash {self.folder}/e/slurm/submit.sh", said)
        self.assertEqual(list((self.folder / "e").glob("all/*")), [])

    def test_a_refusal_of_sbatch_is_told(self):
        said = self.launch("--out", "e", "--members", 1, status=4,
                           sbatch="#!/bin/bash\necho 'invalid partition' >&2\nexit 1\n").stderr
        self.assertIn("invalid partition", said)

    def test_what_makes_no_sense(self):
        for arguments, words in {("--slurm", "time"): "no option of sbatch", ("--slurm=--time=1\n#SBATCH -x",): "one line",
                                 ("--gather",): "--launch", ("--launch", "pbs"): "slurm"}.items():
            ended = self.launch("--out", "e", "--members", 1, *arguments, status=2)
            self.assertIn(words, ended.stdout + ended.stderr)
        ended = self.talus("ensemble", "case.toml", "--slurm=--time=1", status=2)
        self.assertIn("--launch", ended.stderr)
        self.assertFalse((self.folder / "e/slurm/members.sh").exists())


class Plot(ProgramTest):
    def test_a_sweep_is_drawn_against_its_keys(self):
        arguments = ("ensemble", "case.toml", "--out", "e", "--members", 1, "--vary", "slope.angle=30 deg,50 deg",
                     "--vary", "particles.radius=4 mm,5 mm", "--set", "output.pictures=true")
        self.assertIn("Picture: e/sweep.png", self.talus(*arguments).stdout)
        drawn = [(self.folder / "e/sweep.png").read_bytes()]
        for plot in (["front_speed_max"], ["front_speed_max,overlap_max"]):
            self.talus(*arguments, "--gather", "--plot", *plot)
            drawn.append((self.folder / "e/sweep.png").read_bytes())
        self.assertEqual(len(set(drawn)), 3)
        said = self.talus(*arguments, "--gather", "--plot", "front_sped_max", status=2).stderr
        self.assertIn("did you mean 'front_speed_max'", said)

    def test_what_no_member_can_have_is_refused_before_they_run(self):
        said = self.talus("ensemble", "case.toml", "--out", "e", "--members", 1, "--vary", "slope.angle=30 deg,50 deg",
                          "--plot", "front_speed_max,front_sped_max,overlap_mx", status=2).stderr
        self.assertIn("did you mean 'front_speed_max'", said)
        self.assertIn("did you mean 'overlap_max'", said)
        self.assertFalse((self.folder / "e").exists())

    def test_keys_without_numbers_are_drawn_by_the_numbers_of_the_groups(self):
        self.talus("ensemble", "case.toml", "--out", "e", "--members", 1, "--vary",
                   "integration.method=chebyshev,dormand-prince", "--plot", "front_speed_max", "--set",
                   "output.pictures=true")
        self.assertTrue((self.folder / "e/sweep.png").is_file())


if __name__ == "__main__":
    unittest.main()
