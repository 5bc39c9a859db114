# SPDX-License-Identifier: Apache-2.0
"""Reads what a run of Talus leaves in its folder, as numpy arrays that carry their units.

    import talus
    run = talus.Run("results/yuu2011-hopper-air")
    run.series["time"].units                      # "s"
    run.snapshots.at(0.2)["velocity"]             # one row a particle
    run.summary["discharge_rate_plateau"].units   # "kg/s"

`simulate`, `sweep` and `new` start the program, `compare` sets two runs side by side, and tables and snapshots turn into
pandas and xarray (`to_pandas`, `to_xarray`) where these are installed. `talus.draw` (matplotlib) draws particles, fields of
the air and curves into axes of your own. `talus.continuum` interpolates fields of a hopper's particles by the kernel at any
place, with the images behind its walls (`talus.fields`), and finds free surfaces (`talus.surfaces`); `talus.curves` has rates,
spectra and periods.
"""
from talus.column import Column, Value
from talus.comparison import Difference, changed_keys, compare
from talus.program import ProgramError, Sweep, find_program, new, simulate, sweep
from talus.run import Run, find_runs
from talus.snapshots import AirSnapshot, ParticleSnapshot, Snapshots
from talus.table import Table
from talus.trouble import RunError

__version__ = "0.2.0"  # the program's

__all__ = ["AirSnapshot", "Column", "Difference", "ParticleSnapshot", "ProgramError", "Run", "RunError", "Snapshots", "Sweep",
           "Table", "Value", "changed_keys", "compare", "find_program", "find_runs", "new", "simulate", "sweep"]
