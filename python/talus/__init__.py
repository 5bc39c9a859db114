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
import importlib

__version__ = "0.2.0"  # the program's

_HOME = {"column": ["Column", "Value"], "comparison": ["Difference", "changed_keys", "compare"], "ask": ["find_program"],
         "program": ["ProgramError", "Sweep", "new", "simulate", "sweep"], "run": ["Run", "find_runs"],
         "snapshots": ["AirSnapshot", "ParticleSnapshot", "Snapshots"], "table": ["Table"], "trouble": ["RunError"]}
__all__ = sorted(name for names in _HOME.values() for name in names)


def __getattr__(name):
    """Modules are read when something of them is asked for: the program starts some that need no numpy."""
    for module, names in _HOME.items():
        if name in names:
            return getattr(importlib.import_module(f"talus.{module}"), name)
    raise AttributeError(f"module 'talus' has no attribute {name!r}")
