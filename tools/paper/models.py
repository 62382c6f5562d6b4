"""The models of the report, as text for the program."""
import dataclasses
import math
import pathlib

GRAVITY = 9.81  # m/s2, where the paper gives none
# The paper's method as printed: a covering triangle, vertices on edges, plain switching, no damping of the rock.
PAPER = {"mass": "covering", "switching": "plain", "contacts": "points"}


def rock_of(contacts):
    """Keys of the rock and of [contact] that go with contacts of the paper, or with this program's faces."""
    return ("damping = 0.0\n", 'model = "points"\n') if contacts == "points" else ("", "")


def number(value):
    """A float with all its digits."""
    return repr(float(value))


def points(polygon):
    """A list of points as TOML."""
    return "[" + ", ".join(f"[{number(x)}, {number(y)}]" for x, y in polygon) + "]"


def solver(duration, rows, **keys):
    """The tables [solver] and [output]; a value None leaves its key out."""
    lines = ["[solver]", f"duration = {number(duration)}"]
    for key, value in keys.items():
        if isinstance(value, bool):
            lines.append(f"{key} = {str(value).lower()}")
        elif isinstance(value, str):
            lines.append(f'{key} = "{value}"')
        elif isinstance(value, dict):
            inner = ", ".join(f"{name} = {number(part)}" for name, part in value.items())
            lines.append(f"{key} = {{ {inner} }}")
        elif value is not None:
            lines.append(f"{key} = {number(value)}")
    lines += ["[output]", f"every = {number(duration)}", f"history_every = {number(duration / rows)}"]
    return "\n".join(lines) + "\n"


def turned(point, angle, about=(0.0, 0.0)):
    """A point turned by an angle in rad, counter-clockwise."""
    x, y = point[0] - about[0], point[1] - about[1]
    c, s = math.cos(angle), math.sin(angle)
    return about[0] + c * x - s * y, about[1] + s * x + c * y


# The paper's ramp

RAMP_YOUNG = 200e6  # Pa
RAMP_GRAVITY = 9.8  # m/s2


def on_slope(angle, along, across):
    """A point given along (down) and across a slope of `angle` degrees that falls to the right."""
    return turned((along, across), -math.radians(angle))


def ramp(angle, friction, stiffness, duration, rows, contacts="faces", **keys):
    """The paper's 2 m x 1 m block on a ramp that is held; contact springs of `stiffness` N/m. Monitor: centre."""
    def box(x0, x1, y0, y1):
        return points([on_slope(angle, *p) for p in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))])

    damping, model = rock_of(contacts)
    return f"""title = "The paper's ramp"
gravity = [0.0, -{RAMP_GRAVITY}]
[materials.rock]
density = 2750.0
young = {number(RAMP_YOUNG)}
poisson = 0.25
{damping}[joints.ramp]
friction_angle = {number(friction)}
[contact]
{model}normal_stiffness = {number(stiffness)}
[[block]]
name = "ramp"
fixed = true
polygon = {box(-4, 6, -1, 0)}
[[block]]
name = "slider"
polygon = {box(0, 2, 0, 1)}
[[monitor]]
name = "centre"
point = {points([on_slope(angle, 1.0, 0.5)])[1:-1]}
""" + solver(duration, rows, **keys)


def slid(run, angle):
    """How far the centre has moved down the slope, [rows], m."""
    u = run.monitor("centre")
    return u[:, 0] * math.cos(math.radians(angle)) - u[:, 1] * math.sin(math.radians(angle))


# Blocks that rock and topple

def standing_block(width, height, tilt, duration, rows, contacts="faces", **keys):
    """A block on its lower right corner, tilted clockwise about it by `tilt` rad. Monitors: foot, head."""
    polygon = [turned(p, -tilt, about=(width, 0.0)) for p in ((0, 0), (width, 0), (width, height), (0, height))]
    head = turned((0.5 * width, 0.9 * height), -tilt, about=(width, 0.0))
    foot = turned((0.5 * width, 0.1 * height), -tilt, about=(width, 0.0))
    damping, model = rock_of(contacts)
    return f"""title = "A block on its corner"
gravity = [0.0, -{GRAVITY}]
[materials.rock]
density = 2600.0
young = 20e9
poisson = 0.2
{damping}[joints.rough]
friction_angle = 60.0
[contact]
{model}[[block]]
fixed = true
polygon = {points([(-3, -1), (width + 8, -1), (width + 8, 0), (-3, 0)])}
[[block]]
polygon = {points(polygon)}
[[monitor]]
name = "foot"
point = {points([foot])[1:-1]}
[[monitor]]
name = "head"
point = {points([head])[1:-1]}
""" + solver(duration, rows, **keys)


def tilt_of(run, height, tilt):
    """Clockwise tilt of a standing block, [rows], rad."""
    length = 0.8 * height
    apart = run.monitor("head") - run.monitor("foot")
    x = length * math.sin(tilt) + apart[:, 0]
    y = length * math.cos(tilt) + apart[:, 1]
    return [math.atan2(a, b) for a, b in zip(x, y)]


# The paper's cavern

CAVERN_GRAVITY = 10.0  # m/s2, as in the example


def cavern():
    """The example that comes with the program."""
    file = pathlib.Path(__file__).resolve().parents[2] / "examples" / "cavern.toml"
    return file.read_text(encoding="utf-8")


# Squares of jointed rock

ROCK = {"density": 2600.0, "young": 20e9, "poisson": 0.25, "joint": 20e9, "friction": 30.0, "spacing": 1.0}
TILT = math.atan(0.2)  # of the joints, rad


def wave_speed():
    """Of a pulse across the joints, m/s: rock and joints in series."""
    e, nu = ROCK["young"], ROCK["poisson"]
    rock = e * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
    both = 1.0 / (1.0 / rock + 1.0 / (ROCK["joint"] * ROCK["spacing"]))
    return math.sqrt(both / ROCK["density"])


def period(side):
    """Four passages of a wave through a square of `side` m: about its slowest period, s."""
    return 4.0 * side / wave_speed()


@dataclasses.dataclass(frozen=True)
class Square:
    """A square of rock cut by two joint sets that are inclined by TILT, on rollers at three sides.

    tilted: the outline is parallel to the joints, so that all blocks are equal squares of 1 m.
    Otherwise the outline is upright and the joints leave slivers along it; `spacing` is that of the joints.
    """

    side: float
    tilted: bool = True
    spacing: float = ROCK["spacing"]

    def corner(self, u, v):
        """A point given along the sides, from the lower left corner."""
        return turned((u, v), TILT if self.tilted else 0.0)

    def monitors(self):
        """Points spread over the square, in the middle of a block where all are equal."""
        places = ((0.5, 0.1), (0.5, 0.5), (0.5, 0.9), (0.1, 0.5), (0.9, 0.5), (0.1, 0.9), (0.9, 0.9))
        return [self.corner(math.floor(u * self.side) + 0.5, math.floor(v * self.side) + 0.5) for u, v in places]

    def model(self, duration, rows, **keys):
        """As text; gravity acts at once on the unstressed rock."""
        n = self.side
        low_left, low_right = self.corner(0, 0), self.corner(n, 0)
        high_right, high_left = self.corner(n, n), self.corner(0, n)
        text = f"""title = "A square of jointed rock"
gravity = [0.0, -{GRAVITY}]
[materials.rock]
density = {ROCK["density"]}
young = {ROCK["young"]}
poisson = {ROCK["poisson"]}
[joints.rock]
friction_angle = {ROCK["friction"]}
[contact]
normal_stiffness = {0.5 * ROCK["joint"] * ROCK["spacing"]}
[domain]
outline = {points([low_left, low_right, high_right, high_left])}
snap = 1e-6
"""
        for turn in (0.0, 90.0):
            text += (f"[[joint_set]]\nangle = {number(math.degrees(TILT) + turn)}\n"
                     f"spacing = {number(self.spacing)}\n")
        for name, line in (("base", (low_left, low_right)), ("left", (low_left, high_left)),
                           ("right", (low_right, high_right))):
            text += f'[[boundary]]\nname = "{name}"\nalong = {points(line)}\ntype = "roller"\n'
        for k, place in enumerate(self.monitors()):
            text += f'[[monitor]]\nname = "M{k}"\npoint = {points([place])[1:-1]}\n'
        return text + solver(duration, rows, **keys)
