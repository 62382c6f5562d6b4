"""Findings about the paper: equations, inertia, the critical step, the start."""
import math

import numpy as np

from paper import equations, exact, inertia, models
from paper.report import digits, percent, plain, times

BLOCK = ((0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0))   # the paper's, m
SEED = 20180101
DEPTH = 1e-3        # m: penetration for the couple of Eq. 35
ROUNDING = 1e-6
STEPS = (1e-5, 1e-4, 1e-3)


def write(report, program, settings):
    """The section: prose, with its numbers computed."""
    report.heading("Findings about the paper's equations")
    _equations(report)
    _inertia(report, settings)
    _critical_step(report, program)
    _start(report)


def _equations(report):
    generator = np.random.default_rng(SEED)
    h, g = generator.normal(size=6), generator.normal(size=6)
    exact_blocks = equations.hessian_blocks(h, g, 1.0)
    right = equations.apart(equations.as_they_should_read(h, g, 1.0), exact_blocks)
    eq30 = equations.apart(equations.as_printed_30(h, g, 1.0), exact_blocks)
    eq33 = equations.apart(equations.as_printed_33(h, g, 1.0), exact_blocks)
    contacts = [equations.Contact(generator, DEPTH) for _ in range(100)]
    normal = max(float(np.abs(c.printed_normal() - c.gradient()).max()) for c in contacts)
    couple = max(abs(c.shear_couple()) for c in contacts)
    late, new = (equations.velocity_error(0.01, printed) for printed in (True, False))
    jitter = equations.friction_jitter(math.radians(30), math.radians(35), 1e-4)
    report.expect(right < ROUNDING and eq30 > 0.1 and eq33 > 0.1, "findings: contact matrices")
    report.expect(normal < ROUNDING, "findings: Eq. 31")

    report.heading("Equations", 3)
    report.text(
        "A contact spring stores p (S0/l + H.D_i + G.D_j)²/2. The second derivatives of that energy are the stiffness",
        f"blocks, and finite differences of it show which are meant. The versions below agree with them to {digits(right)} of the",
        "largest entry; the printed versions, in the copy we worked from, do not.")
    report.points([
        "**Eqs. 30 and 33** should read K_ii = p H Hᵀ, K_ij = p H Gᵀ, K_ji = p G Hᵀ, K_jj = p G Gᵀ. As printed, Eq. 30 has"
        f" K_ij = p G Hᵀ and K_ji = p G Gᵀ, and its entries are off by up to {percent(eq30)} of the largest; Eq. 33 has K_ij"
        f" and K_ji exchanged, off by up to {percent(eq33)}. The last two lines of Eq. 30 are the load vectors"
        " F_i = -p S0 H/l and F_j = -p S0 G/l; the first of them is printed as a second K_jj.",
        f"**Eq. 31** is right: H and G are the gradient of S0/l, to {digits(normal)}. The gradient leaves out the change"
        " of l, which has no effect where S0 is small.",
        "**Eqs. 34 to 36** agree with each other, but they are no gradient: G in Eq. 35 contains the point P0 alone and not"
        " the rotation of the edge. Shear T then acts along two parallel lines, one through P1 and one through P0, whose"
        f" distance is the penetration, and the pair makes a couple: {digits(couple)} m times T at a penetration of"
        f" {digits(DEPTH)} m. Angular momentum is lost or gained with every contact that carries shear. The gradient of"
        " p s²/2 with s = (P1 - P2).t - xi0 l has no such couple. Nor have this program's faces, whose forces are the gradient of"
        " their energy ([contacts.md](contacts.md)).",
        "**Eq. 37** gives friction its full magnitude and the sign of the last movement. A block that should stick then"
        f" never does: on 30° with 35° of friction and a step of 1e-4 s it vibrates with up to {digits(jitter)} m/s, g h"
        " (sin a + tan phi cos a) at most. Sticking needs the shear spring of Eq. 33, and friction as its limit.",
        "**Eqs. 39 and 40** are consistent with each other; G in Eq. 40 has the opposite sign of that in Eq. 35, and F_j the"
        " opposite sign of that in Eq. 34, so action equals reaction.",
        "**Eq. 13**, second line: the velocity at n + 1 needs the acceleration at n + 1. With that at n, as printed, the"
        f" velocity of an oscillator is {times(late / new)} as wrong. This does not affect the positions, but damping and output use"
        " the velocity.",
        "**Eq. 21** ends in u_3 twice; the last is v_3. **Eq. 27** multiplies the stiffness with the displacement of the step"
        " alone; the stress that the block had before must be added, or total positions used, as here.",
        "**Eq. 41** gives the step as equal to 2/omega; it is a bound, and see below."])


def _inertia(report, settings):
    generator = np.random.default_rng(SEED)
    own = inertia.excess(BLOCK)
    cover = inertia.covering_radius(BLOCK)
    ratios = [inertia.excess(inertia.random_polygon(generator)) for _ in range(settings.polygons)]
    low, middle, high = np.quantile(ratios, (0.05, 0.5, 0.95))
    report.expect(min(ratios) > 1.0, "findings: a covering triangle with less inertia than its block")
    report.heading("The inertia that lumping adds", 3)
    report.text(
        "Row sums of Eq. 23 over a triangle that is centred on the block put a third of the mass on each of its corners. The",
        "paper does not state how large the triangle is; the smallest equilateral one that covers the block is the most",
        "favourable choice. Its corners lie at R_c from the centre, so that the block has the moment of inertia M R_c² in",
        "place of its own J, and a resistance to straining that is larger in the same ratio.",
        f"For the paper's own block of 2 m x 1 m, R_c is {digits(cover, 3)} m and M R_c²/J is",
        f"{digits(own, 3)}. For {settings.polygons} random convex polygons the median is {digits(middle)}, nine in ten lie between",
        f"{digits(low)} and {digits(high)}, and the extremes are {digits(min(ratios))} and {digits(max(ratios))}.",
        "Nodes placed by the block's second moments (`mass = \"matched\"`) cost no more and have the ratio 1.")


SPRING, MASS = 1e6, 1000.0   # N/m per contact and kg, of the two squares
TEXTBOOK = 2.0 * math.sqrt(MASS / (2.0 * SPRING))   # s: 2 sqrt(m/2k)


def _stack(step=None):
    """Two unit squares glued to each other and to a held base, so that no spring ever opens; a light gravity."""
    squares = [[(0, y), (1, y), (1, y + 1), (0, y + 1)] for y in (0, 1)]
    return f"""title = "Two squares on a base"
gravity = [0.0, -0.1]
[materials.soft]
density = {MASS}
young = {0.1 * SPRING}
poisson = 0.0
[joints.glue]
type = "glued"
[contact]
normal_stiffness = {SPRING}
[[block]]
fixed = true
polygon = {models.points([(-1, -1), (2, -1), (2, 0), (-1, 0)])}
[[block]]
polygon = {models.points(squares[0])}
[[block]]
polygon = {models.points(squares[1])}
""" + models.solver(5.0, 100, time_step=step, allow_unstable=step is not None)


def _is_stable(program, step):
    return program.run("stack", _stack(step), may_fail=True).completed


def _critical_step(report, program):
    square = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
    corner = inertia.weights_of_inverse_mass(square, (0.0, 0.0))
    along = inertia.weights_of_inverse_mass(square, (0.0, 0.0), (1.0, 0.0))
    one = math.sqrt(corner)                        # corner on corner: omega^2 = 2 corner k/m, not 2 k/m
    two = math.sqrt(corner + along)                # edge on edge: both corners at once
    bound = program.check("stack", _stack())["critical_step"]
    low, high = bound, TEXTBOOK
    lost = not _is_stable(program, TEXTBOOK)
    report.expect(_is_stable(program, bound), "findings: the bound of the step is not stable")
    report.expect(lost, "findings: the textbook's step is stable")
    while lost and high > 1.02 * low:
        middle = math.sqrt(low * high)
        low, high = (middle, high) if _is_stable(program, middle) else (low, middle)
    report.heading("A step of 2/omega", 3)
    report.text(
        "Eq. 41 asks for the largest eigenvalue of an element; it does not state whether or how contact springs belong to it.",
        "Two blocks of mass m that are connected by a spring k suggest 2 sqrt(m/2k). But a spring at a corner does not have to move the",
        f"whole block: it acts on m/{digits(corner)} of a square. The step is then {digits(one)} times smaller for two corners",
        f"in contact, and {digits(two)} times where edge lies on edge and both corners vibrate together.",
        f"This was tested with two squares glued to a base (k = {digits(SPRING)} N/m, m = {MASS:g} kg): 2 sqrt(m/2k) is {digits(TEXTBOOK)} s",
        f"and {'diverges' if lost else 'does not diverge'}; the largest step that stays stable for 5 s is {digits(low, 3)} s,",
        f"{digits(TEXTBOOK / low)} times smaller. The bound that this program computes holds for blocks that touch others all",
        "round ([contacts.md](contacts.md)), which these blocks do above and below alone:",
        f"{digits(bound, 3)} s, {digits(bound / low)} of what is stable.")


def _start(report):
    acceleration = exact.sliding(30.0, 15.0, models.RAMP_GRAVITY, 1.0) * 2.0
    rows = []
    for step in STEPS:
        steps = round(0.1 / step)
        true = 0.5 * acceleration * (steps * step) ** 2
        rows.append([plain(step)] + [percent(abs(equations.leapfrog_distance(acceleration, step, steps, half) / true - 1.0)
                                             if not half else 0.0) for half in (False,)]
                    + [digits(abs(equations.leapfrog_distance(acceleration, step, steps, True) / true - 1.0), 1)])
    report.heading("The start of the leapfrog", 3)
    report.text(
        "Eq. 13 needs a velocity half a step before the start, and the paper does not state which. Taking v_0 for it adds the",
        "part h/t to the distance of a block that starts without motion; v_0 - a_0 h/2 adds nothing. On the ramp of (30°, 15°), at 0.1 s:")
    report.table(["step (s)", "error with v_{-1/2} = v_0", "error with v_0 - a_0 h/2"], rows)
