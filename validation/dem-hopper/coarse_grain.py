#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Fields, surfaces and numbers of the DEM reference's runs, from the frames that hopper.in writes, as small CSV files.

usage: coarse_grain.py RUN_FOLDER ... [--out data] [--pictures RUN ...]

Rows of other runs in the files are kept. frames.py reads the runs; fields.py and surfaces.py say how packing, velocity,
stress and surfaces are found; tables.py says which numbers there are. Everything is tested on beads at known places in
tests/python/test_dem_hopper.py.
"""
import argparse
import sys
from pathlib import Path

from frames import Run
from tables import Tables, add_run, write_pictures


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--pictures", nargs="*", default=[], metavar="RUN", help="names of runs to be shown as pictures")
    parser.add_argument("--out", type=Path, default=Path(__file__).resolve().parent / "data")
    given = parser.parse_args()
    tables = Tables()
    given.out.mkdir(parents=True, exist_ok=True)
    for folder in given.folders:
        try:
            run = Run(folder)
            add_run(tables, run)
            if run.name in given.pictures:
                write_pictures(given.out, run)
        except (OSError, ValueError) as error:
            sys.exit(f"{error}")
    tables.write(given.out)


if __name__ == "__main__":
    main()
