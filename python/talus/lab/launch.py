# SPDX-License-Identifier: Apache-2.0
"""`talus run --launch slurm`: the run as a job of Slurm. The program has checked the case."""
from pathlib import Path

from talus.ask import find_program
from talus.lab import slurm
from talus.lab.command import arguments, run_command
from talus.trouble import InputError, problem


def main():
    options = arguments("case", texts=("out", "launch", "walltime"), lists=("set", "slurm"), numbers=("nodes", "threads"),
                        flags=("resume",))
    folder = Path(options.out or f"results/{Path(options.case).stem}")
    slurm.check(options.slurm, folder)
    if folder.exists() and not options.resume:
        raise InputError([problem(folder, "is there already", allowed="--resume to go on with the run there, or another "
                                  "--out")])
    command = [str(find_program()), "run", options.case, "--out", str(folder)]
    for option, values in (("--set", options.set), ("--threads", [options.threads]), ("--walltime", [options.walltime])):
        command += [word for value in values if value is not None for word in (option, str(value))]
    return slurm.launch_run(folder, command, options.nodes or 1, options.slurm)


if __name__ == "__main__":
    run_command(main)
