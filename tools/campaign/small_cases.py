# SPDX-License-Identifier: Apache-2.0
"""Cases that take a tenth of a second and write every kind of file."""

CLOUD = """model = "cloud"
seed = 3
motion = "xy"
[particles]
shape = "circle"
count = 60
size = "60 mm"
radius = "5 mm"
density = "20 kg/m3"
[slope]
angle = "45 deg"
[integration]
max_step = 0.003
[run]
end = "0.6 ms"
[output]
snapshots = "0.1 ms"
pictures = false
checkpoint_interval = "15 ms"
"""

# Some steps of settling, then the gate, some hundred in all; forty particles of 5 mm.
HOPPER = """model = "continuum"
[box]
width = "50 mm"
depth = "5 mm"
height = "90 mm"
[plate]
height = "40 mm"
slit_left = "10 mm"
slit_right = "40 mm"
[gate]
opens = "when-settled"
[grains]
density = "2500 kg/m3"
diameter = "200 um"
[bed]
packing = 0.6
spacing = "5 mm"
height = "20 mm"
[air]
enabled = true
continuity = "air-alone"
formulation = "model-b"
cell = "5 mm"
[settle]
max_time = "10 ms"
duration = "0.2 ms"
speed = "200 mm/s"
damping_time = "0.3 ms"
loading_time = "0 s"
[integration]
method = "leapfrog"
courant = 0.6
[run]
end = "4 ms"
[output]
snapshots = "0.5 ms"
series = "0.1 ms"
pictures = false
checkpoint_interval = "15 ms"
"""

# Coarser particles that split on their way to the slit, of which some merge below it.
LEVELS = """model = "continuum"
[box]
width = "120 mm"
depth = "20 mm"
height = "140 mm"
floor = "open"
[plate]
height = "30 mm"
slit_left = "45 mm"
slit_right = "75 mm"
[removal]
below = "20 mm"
[gate]
opens = "when-settled"
[grains]
density = "2500 kg/m3"
diameter = "1 mm"
[bed]
packing = 0.6
spacing = "5 mm"
height = "80 mm"
velocity = ["0 m/s", "0 m/s", "-0.5 m/s"]
[levels]
count = 1
distance = "20 mm"
[settle]
max_time = "10 ms"
duration = "0.2 ms"
speed = "2 m/s"
loading_time = "0 s"
[run]
end = "60 ms"
[output]
snapshots = "5 ms"
series = "1 ms"
pictures = false
report = false
checkpoint_interval = "15 ms"
"""

# A study under a name that `talus reproduce` knows: two variants of the cloud, one row that is met.
REFERENCE = """study = "niiya2020"
title = "A small study"
source = "the campaign"
members = 2
time_unit = "a/v_s"
[case.circle]
file = "cloud.toml"
where = { "particles.shape" = "circle" }
told_by = ["slope.angle"]
[case.circle.radius]
"flat" = { "slope.angle" = "30 deg" }
"steep" = { "slope.angle" = "50 deg" }
[[row]]
id = "speed"
number = 1
quantity = "front_speed_max"
case = "circle"
radius = ["flat", "steep"]
estimator = "front_speed"
from = "each"
window = { from = 0, to = "end" }
printed = "between"
unit = "1"
criterion = { between = [0, 1e9] }
source = "the campaign"
"""

# In place of figures: a page that is made of what the program wrote.
FIGURES = """import pathlib, sys
folder = pathlib.Path(sys.argv[1])
text = (folder / "comparison.txt").read_text()
(folder / "page.md.part").write_text(text)
(folder / "page.md.part").rename(folder / "page.md")
"""
