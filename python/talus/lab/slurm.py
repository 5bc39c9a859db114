# SPDX-License-Identifier: Apache-2.0
"""Jobs of Slurm: one run on the processors of several nodes; the members of an ensemble as an array job, one task each, and
a job after them that gathers. Source: Slurm 22.05, "sbatch" and "Job Array Support",
https://slurm.schedmd.com/job_array.html"""
import os
import shutil
import subprocess
from pathlib import Path
from shlex import join, quote

from talus.ask import ask, write
from talus.lab.command import DONE, say
from talus.trouble import InputError, RunError, problem

MEMBERS = """#!/bin/bash
# The members of {ensemble}, one task each. Written by talus ensemble --launch slurm.
#SBATCH --job-name=talus
#SBATCH --array=0-{last}{at_once}
#SBATCH --cpus-per-task=1
#SBATCH --signal=B:TERM@120
#SBATCH --output={output}
#SBATCH --open-mode=append
{options}cd {here} || exit 4

# member FOLDER COMMAND...: goes on where the folder is there. What it says goes beside the folder.
member() {{
  local folder=$1
  shift
  if [[ -e $folder ]]; then set -- "$@" --resume; fi
  exec "$@" > "$folder.out" 2>&1
}}

case $SLURM_ARRAY_TASK_ID in
{tasks}  *) echo "there is no member $SLURM_ARRAY_TASK_ID" >&2; exit 2 ;;
esac
"""
GATHER = """#!/bin/bash
# Statistics, tables and pictures of the members that are done.
#SBATCH --job-name=talus-gather
#SBATCH --cpus-per-task=1
#SBATCH --output={output}
cd {here} || exit 4
exec {command}
"""
SUBMIT = """#!/bin/bash
# Submits the members, and what gathers them when all have ended, well or not.
set -euo pipefail
members=$(sbatch --parsable {members})
members=${{members%%;*}}
gather=$(sbatch --parsable --dependency="afterany:$members" {gather})
echo "members: job $members; gathered by job ${{gather%%;*}}"
"""


RUN = """#!/bin/bash
# One run on several nodes. Written by talus run --launch slurm.
#SBATCH --job-name=talus
#SBATCH --nodes={nodes}
#SBATCH --ntasks-per-node=1
#SBATCH --exclusive
#SBATCH --signal=USR1@120
#SBATCH --output={output}
#SBATCH --open-mode=append
{options}cd {here} || exit 4

# Goes on where the folder is there: a job that begins again, too. Each process takes its share of the node's processors.
if [[ -e {folder} ]]; then set -- --resume; fi
exec srun --cpu-bind=none {command} "$@"
"""


def _is_plain(text):
    return not any(ord(c) < 32 or ord(c) == 127 or c == '"' for c in text)


def _in_directive(path):
    """A file name within a directive: "%" begins a pattern there."""
    return '"' + str(path).replace("%", "%%") + '"'


def check(options, folder):
    """Raises InputError if an option is none of sbatch, or the folder's path cannot be written in a script."""
    faults = [problem(f"--slurm {option}", "is no option of sbatch on one line", allowed="such as --slurm=--time=2:00:00")
              for option in options if not option.startswith("-") or not _is_plain(option)]
    if not _is_plain(os.path.abspath(folder)):
        faults.append(problem(folder, "cannot be named in a script of Slurm", allowed="another --out"))
    if faults:
        raise InputError(faults)


def _directives(options):
    """Behind those of a script: of an option that is given twice sbatch takes the second."""
    return "".join(f"#SBATCH {option}\n" for option in options)


def _submit(command, what):
    """Runs a command that submits jobs, where there is sbatch. \\param what it submits, in words"""
    if not shutil.which("sbatch"):
        say(f"There is no sbatch here. Where there is: {join(map(str, command))}")
        return
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)
    if done.returncode != 0:
        raise RunError(f"{command[-1]}: sbatch refused: {done.stdout.strip()}")
    say(f"Submitted {what}: {done.stdout.strip()}")


def launch_run(folder, command, nodes, options):
    """Submits a run, whose script and output go beside its folder. \\param command the run's, the program first, without
    --resume"""
    job = Path(f"{os.path.abspath(folder)}-slurm")
    ask("claim", folders=[job], files=[job / "job.out"])
    write({job / "job.sh": RUN.format(nodes=nodes, output=_in_directive(job / "job.out"), options=_directives(options),
                                      here=quote(os.getcwd()), folder=quote(str(folder)), command=join(command))})
    _submit(["sbatch", "--parsable", str(job / "job.sh")], f"a run on {nodes} node{'s' * (nodes != 1)}")
    say(f"Results: {folder}")
    return DONE


def _write_scripts(folder, members, gathering, at_once, options):
    """FOLDER/slurm/members.sh (the array job), gather.sh (the job after it) and submit.sh (what submits both), whose path is
    returned. A task whose folder is there resumes, so that a task may be requeued; Slurm tells it two minutes before its limit
    of time, and it leaves with a checkpoint."""
    slurm = Path(os.path.abspath(folder)) / "slurm"
    here = quote(os.getcwd())
    ask("claim", folders=[slurm, *{member.folder.parent: 0 for member in members}],
        files=[member.output for member in members])
    tasks = "".join(f"  {k}) member {quote(str(member.folder))} {join(member.command())} ;;\n"
                    for k, member in enumerate(members))
    write({slurm / "members.sh": MEMBERS.format(
        ensemble=slurm.parent, last=len(members) - 1, at_once=f"%{at_once}" if at_once else "", here=here, tasks=tasks,
        output=_in_directive(slurm / "tasks.out"), options=_directives(options)),
           slurm / "gather.sh": GATHER.format(output=_in_directive(slurm / "gather.out"), here=here, command=join(gathering)),
           slurm / "submit.sh": SUBMIT.format(members=quote(str(slurm / "members.sh")),
                                              gather=quote(str(slurm / "gather.sh")))})
    return slurm / "submit.sh"


def launch(folder, runs, gathering, at_once, options):
    """Submits the runs that are not done, where there is sbatch. \\param gathering the command that gathers, the program first
    \\param at_once tasks at a time; None: as Slurm likes"""
    members = [member for member in runs if not member.is_done()]
    if not members:
        say(f"All {len(runs)} runs are done already; --gather makes the tables.")
        return DONE
    _submit(["bash", str(_write_scripts(folder, members, gathering, at_once, options))], f"{len(members)} runs")
    say(f"Results: {folder}")
    return DONE
