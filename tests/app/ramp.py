"""A model of a block on a ramp, and a folder with it for each test."""
from program import Program

RAMP = """title = "Ramp \\"quoted\\""
[materials.rock]
density = 2750.0
young = 2e8
poisson = 0.25
[joints.ramp]
friction_angle = 15.0
[[block]]
name = "ramp"
fixed = true
polygon = [[-1, -1], [4, -1], [4, 0], [-1, 0]]
[[block]]
name = "slider"
polygon = [[0, 0], [2, 0], [2, 1], [0, 1]]
velocity = [1.0, 0.0]
[[monitor]]
name = "M"
point = [1.0, 0.5]
[solver]
duration = 0.01
[output]
every = 0.005
history_every = 0.001
"""


class RampProgram(Program):
    def setUp(self):
        super().setUp()
        (self.dir / "m.toml").write_text(RAMP)

    def names(self):
        return sorted(p.name for p in self.dir.iterdir())
