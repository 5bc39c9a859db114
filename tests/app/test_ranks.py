# SPDX-License-Identifier: Apache-2.0
"""Cases on several processes, as users start them. Skipped where the program was built without MPI."""
import os
import pathlib
import re
import signal
import subprocess
import sys
import unittest

import program

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
import hash_ranks  # noqa: E402

BUILD = pathlib.Path(program.PROGRAM).parent


class Ranks(program.ProgramTest):
    def check_same(self, name, layouts):
        case, settings = hash_ranks.CASES[name]
        expected = hash_ranks.hash_of_run(None, BUILD, self.folder / "alone", case, settings)
        for ranks, threads in layouts:
            found = hash_ranks.hash_of_run(ranks, BUILD, self.folder / f"{ranks}-{threads}", case, settings, threads)
            self.assertEqual(found, expected, f"{name} on {ranks} processes of {threads} threads")

    def test_plate(self):
        self.check_same("hopper, vacuum", [(2, 2), (3, 1), (8, 1)])

    def test_single_precision(self):
        self.check_same("hopper, vacuum, single precision", [(2, 1), (3, 1), (8, 1)])

    def test_air(self):
        self.check_same("hopper, air", [(2, 1), (3, 2)])

    def test_air_whose_cells_are_shared(self):
        self.check_same("shared air", [(2, 2), (3, 1)])

    def test_vessel(self):
        self.check_same("silo of round walls", [(2, 1), (3, 1), (8, 1)])

    def test_cloud(self):
        self.check_same("cloud in a plane", [(2, 2), (3, 1), (8, 1)])

    def test_cloud_in_space(self):
        self.check_same("cloud in space, single precision", [(2, 1), (5, 1)])

    def test_cloud_of_the_spectral_sum(self):
        self.check_same("cloud, spectral sum", [(3, 1)])

    def test_inlet_and_removal(self):
        self.check_same("chute with inlet and removal", [(2, 1), (3, 1), (8, 1)])

    def test_particles_of_several_sizes(self):
        self.check_same("silo of three sizes", [(2, 1), (3, 1), (8, 1)])

    def test_particles_of_several_sizes_in_a_sector(self):
        self.check_same("sector of two sizes", [(2, 2), (3, 1), (8, 1)])

    def run_hopper(self, ranks, program_name, out, *options, name="hopper, vacuum"):
        case, settings = hash_ranks.CASES[name]
        words = hash_ranks.words_of_run(BUILD / program_name, self.folder / out, case, settings, 1)
        return hash_ranks.start(ranks, words + list(options))

    def check_resumed(self, name, ends):
        case, settings = hash_ranks.CASES[name]
        expected = hash_ranks.hash_of_run(None, BUILD, self.folder / "alone", case, settings)
        for (ranks, program_name), end in zip([(2, "talus-mpi"), (3, "talus-mpi"), (None, "talus")], ends):
            resume = ["--resume"] if (self.folder / "parts").exists() else []
            done = self.run_hopper(ranks, program_name, "parts", *resume, "--set", f"run.end={end}", name=name)
            self.assertEqual(done.returncode, 0, done.stderr)
        found = hash_ranks.hash_of_checkpoint(hash_ranks.newest_checkpoint(self.folder / "parts"))
        self.assertEqual(found, expected.split()[0])

    def test_resumed_on_another_number_of_processes(self):
        self.check_resumed("hopper, vacuum", ["3 ms", "5 ms", "8 ms"])

    def test_particles_of_several_sizes_resumed_on_another_number_of_processes(self):
        self.check_resumed("sector of two sizes", ["5 ms", "10 ms", "16 ms"])

    def test_cloud_resumed_on_another_number_of_processes(self):
        self.check_resumed("cloud in a plane", ["0.1 ms", "0.2 ms", "0.4 ms"])

    def start_run(self, ranks, folder, settings):
        """A run that goes on until it is stopped, past its first checkpoint."""
        case, short = hash_ranks.CASES["hopper, vacuum"]
        words = hash_ranks.words_of_run(BUILD / "talus-mpi", folder, case, {**short, **settings}, 1)
        running = subprocess.Popen([*hash_ranks.MPIRUN, "-n", str(ranks), *map(str, words)], env=hash_ranks.ENVIRONMENT,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(self._end, running)
        self.wait_until((folder / "checkpoint_b.h5").exists, running)
        return running

    def test_stops_by_a_signal_with_a_checkpoint(self):
        running = self.start_run(2, self.folder / "stopped", {"run.end": "100 s", "output.checkpoint_interval": "0.2 s"})
        running.send_signal(signal.SIGUSR1)
        said = running.communicate(timeout=60)[0]
        self.assertEqual(running.returncode, 130, said)
        self.assertIn("Interrupted by SIGUSR1", said)

    def test_a_process_that_is_killed_ends_all_and_the_run_goes_on(self):
        end = {"run.end": "60 ms", "output.checkpoint_interval": "0.05 s"}
        running = self.start_run(3, self.folder / "killed", end)
        children = subprocess.run(["pgrep", "-P", str(running.pid), "talus-mpi"], capture_output=True, text=True,
                                  check=True).stdout.split()
        os.kill(int(children[1]), signal.SIGKILL)
        said = running.communicate(timeout=60)[0]
        self.assertEqual(running.returncode, 137, said)
        case, settings = hash_ranks.CASES["hopper, vacuum"]
        settings = {**settings, **end}
        words = hash_ranks.words_of_run(BUILD / "talus-mpi", self.folder / "killed", case, settings, 1)
        resumed = hash_ranks.start(2, words + ["--resume"])
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        whole = hash_ranks.hash_of_run(None, BUILD, self.folder / "whole", case, settings)
        found = hash_ranks.hash_of_checkpoint(hash_ranks.newest_checkpoint(self.folder / "killed"))
        self.assertEqual(found, whole.split()[0])

    def test_the_forecast_knows_the_copies(self):
        case, settings = hash_ranks.CASES["hopper, vacuum"]
        settings = {**settings, "bed.spacing": "2.5 mm", "run.end": "0.2 ms"}
        for ranks in 2, 5:
            run = hash_ranks.start(ranks, hash_ranks.words_of_run(BUILD / "talus-mpi", self.folder / f"{ranks}", case,
                                                                  settings, 1))
            self.assertEqual(run.returncode, 0, run.stderr)
            found = float(re.search(r"\(of one ([\d.]+) %\)", (self.folder / f"{ranks}/log.txt").read_text())[1])
            said = self.talus("check", hash_ranks.hash_cases.CASES / f"{case}.toml", "--set", "bed.spacing=2.5 mm", "--ranks",
                              ranks).stdout
            self.assertIn(f"On {ranks} processes (modelled", said)
            expected = float(re.search(r"copies of .* \((\d+) %\)", said)[1])
            self.assertLess(abs(expected - found), 0.35 * found, f"{ranks} processes")

    def test_the_forecast_knows_what_a_cloud_shares(self):
        case = hash_ranks.hash_cases.CASES / "niiya2020-circle.toml"
        said = self.talus("check", case, "--ranks", 4).stdout
        self.assertIn("On 4 processes (modelled", said)
        self.assertIn("all 2000 on each; 16 tasks of the sum", said)
        self.assertRegex(said, r"efficiency 0\.\d\d")
        said = self.talus("check", case, "--ranks", 4, "--set", "fluid.sum=spectral").stdout
        self.assertIn("the first process computes the spectral sum", said)
        self.assertIn("efficiency 0.25", said)

    def test_processes_that_a_case_cannot_have_are_refused_beforehand(self):
        for case, ranks, words in (("cavity", 2, "on one process only"), ("drum", 100000, "for 100000 processes"),
                                   ("niiya2020-circle", 3000, "grains for 3000 processes")):
            said = self.talus("check", hash_ranks.hash_cases.CASES / f"{case}.toml", "--ranks", ranks, status=2).stderr
            self.assertIn(words, said)

    def test_hands_over(self):
        done = self.run_hopper(2, "talus", "handed")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("Done:"), 1)

    def test_its_report_is_made(self):
        done = self.run_hopper(2, "talus", "r", "--set", "output.report=true")
        self.assertEqual(done.returncode, 0, done.stderr)  # Python, which it starts, asks the program

    def test_refuses_what_runs_on_one_process(self):
        words = hash_ranks.words_of_run(BUILD / "talus-mpi", self.folder / "refused", "cavity", {}, 1)
        done = hash_ranks.start(2, words)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("model: ", done.stderr)
        self.assertIn("on one process only", done.stderr)
        self.assertFalse((self.folder / "refused").exists())

    def test_faults_are_said_once_with_their_status(self):
        self.assertEqual(self.run_hopper(2, "talus-mpi", "fault", "--set", "bed.spacing=-1 mm").returncode, 2)
        done = self.run_hopper(2, "talus-mpi", "fault", "--set", "settle.speed=1 nm/s", "--set", "settle.max_time=2 ms")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(done.stderr.count("talus: "), 1, done.stderr)
        self.assertEqual(self.run_hopper(2, "talus-mpi", "fault").returncode, 2, "the folder is there")


if __name__ == "__main__":
    if not (BUILD / "talus-mpi").exists():
        sys.exit(77)
    unittest.main()
