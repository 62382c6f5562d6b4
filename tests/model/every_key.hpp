// A model of every key.
#pragma once

#include <string>

namespace edda::testing {

// No key has its default here.
inline const std::string every_key = R"(title = "Every \"key\"\t\\ é"
gravity = ["1 m/s2", -9.8]
plane = "stress"
deformation = "corners"
thickness = "50 cm"
[materials.rock]
density = 2750
young = "20 GPa"
poisson = 0.25
damping = 0.2
rayleigh = { fraction = "3 %", frequency = "2 Hz" }
deformation = "uniform"
strength = { ucs = "90 MPa", tension = 6e6 }
[materials."soft clay"]
unit_weight = "20 kN/m3"
young = 5e6
poisson = "40 %"
[joints.glue]
type = "glued"
[joints.rough]
friction_angle = "0.5 rad"
cohesion = "50 kPa"
tensile_strength = 1e3
residual = { friction_angle = 12, cohesion = "1 kPa", tensile_strength = 2.5 }
kn = "20 GPa/m"
ks = 9e9
aperture = "0.2 mm"
residual_aperture = 3e-5
largest_aperture = "1 mm"
restitution = 0.4
[joints.weak]
type = "slip-weakening"
friction_angle = 35
residual = { friction_angle = 25 }
dilation_angle = 4
slip_distance = "5 mm"
aperture = 0
[joints.tough]
friction_angle = 35
cohesion = "10 MPa"
tensile_strength = "4 MPa"
fracture_energy = "40 J/m2"
shear_fracture_energy = 400
aperture = 0
[joints.barton]
type = "barton-bandis"
jrc = 9
jcs = "80 MPa"
residual_angle = 28
aperture = 0
[joints.weaker]
type = "slip-weakening"
friction_angle = 33
residual = { friction_angle = 20 }
dilation_angle = 4
slip_distance = "5 mm"
decay_time = "30 d"
aperture = 0
[contact]
model = "faces"
normal_stiffness = "200 MN/m"
shear_stiffness = 1e8
joint = "rough"
close_gaps = "15 mm"
[[block]]
name = "slider"
polygon = [[0, 0], [0, "10 cm"], [1, 1], [2, -0.0]]
material = "soft clay"
joint = "glue"
velocity = ["1 mm/s", -0.1]
angular_velocity = 0.3
[[block]]
polygon = [[-5, -5], [-4, -5], [-4, -4]]
material = "rock"
fixed = true
[domain]
outline = [[10, 0], [20, 0], [20, 10], [10, 10]]
material = "rock"
joint = "rough"
snap = "1 um"
max_blocks = 2_000_000_000
[section]
azimuth = 75
[[joint_set]]
name = "bedding"
angle = -400.5
spacing = 0.7
origin = [0.1, 0.2]
joint = "glue"
region = [[11, 1], [19, 1], [15, 9]]
trace_length = "3 m"
gap = 0.25
stagger = "-50 cm"
deviation = { angle = 3, spacing = 0.1, trace_length = 1, gap = 0.2, distribution = "normal" }
seed = 7
[[joint_set]]
name = "beds"
dip = 60
dip_direction = 300
spacing = 4
[[joint_set]]
angle = 90
spacing = 2
bounded_by = "beds"
[[trace]]
points = [[11, 1], [12, 5], [13, 5]]
joint = "rough"
[[fracture_network]]
name = "f"
p21 = "1.2 1/m"
angle = { mean = 30, deviation = 4, distribution = "uniform" }
length = { mean = 3, deviation = 1 }
joint = "glue"
region = [[11, 1], [12, 1], [12, 2]]
seed = 8
[[fracture_network]]
count = 9
angle = { mean = 1 }
length = { distribution = "power", exponent = 2.5, min = 1, max = 4 }
[[fracture_network]]
model = "veneziano"
persistence = 0.6
count = 5
angle = { mean = 1 }
length = { distribution = "exponential", mean = 2 }
[voronoi]
size = 2
smoothing = 3
min_edge = "50 cm"
joint = "glue"
region = [[11, 1], [12, 1], [12, 2]]
seed = 9
[[import]]
file = "t.csv"
units = "cm"
scale = 2
shift = [1, 2]
snap = "2 mm"
layers = { "J 1" = "glue", b = "rough" }
joint = "glue"
[[import]]
file = "b.dxf"
as = "blocks"
material = "rock"
materials = { STONE = "soft clay" }
fixed = ["BASE"]
[[opening]]
name = "cavern"
polygon = [[14, 4], [16, 4], [16, 6], [14, 6]]
joint = "glue"
[[opening]]
shape = { kind = "horseshoe", at = [12, 7], width = 2, height = "1.5 m", segments = 24 }
[[region]]
polygon = [[11, 1], [12, 1], [12, 2]]
material = "soft clay"
joint = "glue"
[[fixed]]
point = [15, 1]
[[fixed]]
point = [15, 2]
[[brick_wall]]
origin = [30, 1]
columns = 4
rows = 3
brick = [1.0, 0.5]
material = "rock"
joint = "rough"
[[arch]]
centre = [50, 1]
radius = 5
thickness = 0.5
count = 7
from_angle = 10
to_angle = 170
material = "rock"
joint = "rough"
[quality]
min_area = "1 dm2"
min_edge = 0.05
min_angle = 2
action = "report"
[[contact_pair]]
between = ["rock", "soft clay"]
joint = "glue"
[initial_stress]
stress = ["-24 MPa", -20e6, 0.5]
at_y = "2 m"
gradient = [1e4, "27 kPa/m", 2.0]
k0_out = 0.75
[[boundary]]
name = "base"
sides = ["bottom", "left"]
type = "roller"
stiffness = 2e11
[[boundary]]
name = "line"
along = [[10, 10], [15, 10], [20, 10]]
[[boundary]]
name = "far"
sides = ["right"]
type = "viscous"
wave_speeds = ["3 km/s", 1500]
[[boundary]]
sides = ["top"]
type = "stress"
traction = [0.5, "-100 kPa"]
history = "tests/model/rise.csv"
[[boundary]]
sides = ["left"]
type = "velocity"
velocity = ["1 mm/s", -0.5]
frictionless = true
[[boundary]]
name = "yielding"
along = [[0, 0], [1, 0]]
type = "displacement"
displacement = ["1 mm", -0.02]
[[load]]
name = "axle"
point = [15, 10]
force = ["2 kN", -1e5]
[[load]]
along = [[10, 10], [20, 10]]
pressure = "3 kPa"
history = "tests/model/rise.csv"
[[load]]
within = [[10, 10], [20, 10], [15, 15]]
body_force = ["1 kN/m3", -5.0]
[[water]]
name = "wet"
table = [[0, 4], [30, 5]]
flooded = ["cavern"]
unit_weight = "10 kN/m3"
history = "tests/model/rise.csv"
[[water]]
level = "3 m"
unit_weight = 1e4
along = [[0, 0], [0, 9]]
[[water]]
table = [[0, 4], [30, 5]]
unit_weight = 1e4
sides = ["left"]
[[water]]
name = "storm"
rain = "36 mm/h"
unit_weight = 1e4
[[water]]
injection = "2e-4 m2/s"
at = [15, 2]
unit_weight = 1e4
[flow]
viscosity = "1.3 mPa s"
bulk_modulus = "2 GPa"
[[shaking]]
name = "quake"
acceleration = "tests/model/quake.at2"
direction = [0, 2]
units = "g"
component = 2
scale = -0.5
apply = "inertia"
[[shaking]]
acceleration = { amplitude = "5 m/s2", frequency = "2 Hz", direction = [1, 1] }
apply = "upgoing"
boundary = "far"
[[bolt]]
name = "crown"
from = [15, 6]
to = [15, "9 m"]
type = "end"
diameter = "25 mm"
young = "210 GPa"
yield_stress = "500 MPa"
rupture_strain = "8 %"
spacing = "1.5 m"
pretension = "30 kN"
[[bolt_pattern]]
name = "round"
opening = "cavern"
from_angle = 10
to_angle = 170
count = 9
length = "2 m"
type = "grouted"
diameter = 0.02
young = 2e11
yield_stress = 4e8
rupture_strain = 0.05
spacing = 2.0
pretension = 1e3
bond = { stiffness = "1 GN/m2", strength = "400 kN/m" }
dowel = { stiffness = "100 MN/m", strength = "150 kN" }
[[bolt_pattern]]
opening = "cavern"
from_angle = 10
to_angle = 20
count = 2
length = 2
diameter = 0.02
yield_stress = 4e8
bond = { stiffness = 1e9, strength = 4e5 }
dowel = { bearing_strength = "60 MPa", foundation_modulus = "20 GPa" }
[[lining]]
name = "shell"
opening = "cavern"
from_angle = -10
to_angle = 190
material = "rock"
thickness = "15 cm"
compressive_strength = "20 MPa"
tensile_strength = "2 MPa"
residual = { compressive_strength = "12 MPa", tensile_strength = "0.3 MPa" }
size = 0.4
interface = "rough"
[[lining]]
name = "second"
on = "shell"
material = "rock"
area = "40 cm2"
inertia = "573 cm4"
spacing = 1.2
compressive_strength = 2.5e8
plastic_moment = "30 kN m"
interface = "rough"
[[lining]]
along = [[0, 0], [5, 0], [5, "50 cm"]]
material = "rock"
thickness = 0.1
[[fill]]
name = "paste"
opening = "cavern"
lift = "2 m"
material = "soft clay"
joint = "rough"
[[fill]]
name = "bund"
polygon = [[0, 0], [5, 0], [5, "50 cm"]]
material = "rock"
[[monitor]]
name = "P1"
point = [15, 9]
[[measurement]]
name = "roof"
polygon = [[11, 5], [19, 5], [15, "8 m"]]
[[convergence]]
name = "H1"
between = [[11, 5], ["19 m", 5]]
[[stage]]
name = "settle"
until = "equilibrium"
ratio = 1e-4
duration = "1 min"
damping = { contact = 0.2 }
joints = "glued"
detached = "wait"
otherwise = "stop"
deactivate = ["wet"]
[[stage]]
duration = 60.0
excavate = ["cavern"]
relax = { cavern = 0.6 }
install = ["round", "shell", "second"]
fill = ["paste", "bund"]
change = [{ joints = "rough", to = "weak", region = [[11, 1], [12, 1], [12, 2]], around = "cavern", distance = "2 m" }, { joints = "weak", to = "weaker", set = "bedding", over = "2 s" }]
activate = ["axle", "wet"]
masses = "as given"
reset_displacements = true
strength_factor = 1.25
[[stage]]
name = "push"
until = "collapse"
duration = 0.1
ramp = { "load:axle" = [0, 2.5], hold = "equilibrium", steps = 50 }
[solver]
method = "edda"
mass = "covering"
switching = "plain"
duration = "125.1 s"
time_step = 1e-5
allow_unstable = true
safety = 0.7
dynamic = true
max_displacement_ratio = "2 %"
mass_scaling = "3 us"
damping = { mass = "2 1/s", local = 0.1, contact = 0.3, adaptive = 0.4, rayleigh = { fraction = "5 %", frequency = "3 Hz" } }
[output]
every = 0.3
history_every = 0.07
settling = true
checkpoint_every = 2.5
stages = false
[fos]
stage = "settle"
vary = "water:wet"
bracket = [0.7, 2]
tolerance = 0.02
exclude = ["glue"]
least_area = 0.25
rigid_proof = false
fails = { displacement = "1 cm", velocity = "2 mm/s" }
[limit]
crushing = true
)";

// In place of stress, at_y and gradient.
inline const std::string every_weight_key = R"([initial_stress]
k0 = 1.2
k0_out = 0.9
surface_y = "150 m"
surface = "level"
)";

// A model of its own: rock yields in plane strain alone.
inline const std::string every_zones_key = R"([materials.rock]
density = 2750
young = "20 GPa"
poisson = 0.25
zone_size = "0.4 m"
pore_pressure = false
yield = { friction_angle = 35, cohesion = "1 MPa", tensile_strength = 2e5, dilation_angle = 5, slip_distance = "8 mm", residual = { friction_angle = 30, cohesion = 0, dilation_angle = 0 } }
foliation = { angle = 20, friction_angle = 25, cohesion = "0.1 MPa", tensile_strength = 1e4, dilation_angle = 3 }
[materials.marl]
density = 2600
young = "5 GPa"
poisson = 0.3
yield = { ucs = "40 MPa", gsi = 45, mi = 9, disturbance = 0.3 }
[materials.shale]
density = 2600
young = "5 GPa"
poisson = 0.3
yield = { ucs = "40 MPa", m = 0.9, s = 1e-3, a = 0.51 }
[materials.slate]
density = 2600
young = "50 GPa"
poisson = 0.2
foliation = { angle = 70, young = "20 GPa", poisson = 0.1, shear_modulus = "8 GPa" }
[joints.j]
friction_angle = 30
[zones]
size = "0.5 m"
growth = 0.2
[[block]]
polygon = [[0, 0], [2, 0], [2, 2], [0, 2]]
material = "rock"
[[stage]]
duration = 1
change = [{ material = "marl", to = "shale" }]
[solver]
duration = 1
)";

// In place of an outline.
inline const std::string every_slope_key = R"([slope]
toe = [12, 2]
height = 6
face_angle = 80
base_y = 0.5
extent = [10, 20]
benches = 2
bench_width = 1.5
)";

}  // namespace edda::testing
