"""The paper's contact matrices against the energy they come from.

A spring of stiffness p between two blocks stores p (c + H.D_i + G.D_j)^2/2, with c the gap at the start of the step.
Its second derivatives are the stiffness blocks, its negative first derivatives at D = 0 the forces.
"""
import numpy as np


def hessian_blocks(h, g, p):
    """K_ii, K_ij, K_ji, K_jj by differences of the energy, which is quadratic, so that they are exact."""
    n = len(h)

    def energy(d):
        return 0.5 * p * (h @ d[:n] + g @ d[n:]) ** 2

    unit = np.eye(2 * n)
    single = np.array([energy(u) for u in unit])
    k = np.array([[energy(a + b) - single[i] - single[j] for j, b in enumerate(unit)] for i, a in enumerate(unit)])
    return k[:n, :n], k[:n, n:], k[n:, :n], k[n:, n:]


def as_they_should_read(h, g, p):
    """p H H^T, p H G^T, p G H^T, p G G^T."""
    return p * np.outer(h, h), p * np.outer(h, g), p * np.outer(g, h), p * np.outer(g, g)


def as_printed_30(h, g, p):
    """Eq. 30: K_ij with its factors swapped, K_ji with G twice."""
    return p * np.outer(h, h), p * np.outer(g, h), p * np.outer(g, g), p * np.outer(g, g)


def as_printed_33(h, g, p):
    """Eq. 33: K_ij and K_ji each with its factors swapped."""
    return p * np.outer(h, h), p * np.outer(g, h), p * np.outer(h, g), p * np.outer(g, g)


def apart(blocks, exact):
    """Largest difference of any entry, over the largest entry."""
    return max(float(np.abs(a - b).max()) for a, b in zip(blocks, exact)) / max(float(np.abs(b).max()) for b in exact)


class Contact:
    """A vertex P1 against an edge P2 P3, at random; normal (Eqs. 31, 32) and shear (Eqs. 35, 36)."""

    def __init__(self, generator, depth):
        angle = generator.uniform(0.0, 2.0 * np.pi)
        t = np.array([np.cos(angle), np.sin(angle)])
        n = np.array([-t[1], t[0]])
        self.p2 = generator.uniform(-1.0, 1.0, 2)
        self.length = generator.uniform(0.5, 2.0)
        self.p3 = self.p2 + self.length * t
        self.p0 = self.p2 + generator.uniform(0.2, 0.8) * self.length * t
        self.p1 = self.p0 - depth * n
        self.depth = depth

    def normal_gap(self, moved):
        """S0/l, Eq. 32, where (P1, P2, P3) move by `moved`, [6]; l as it was."""
        (x1, y1), (x2, y2), (x3, y3) = np.reshape(moved, (3, 2)) + (self.p1, self.p2, self.p3)
        return float(np.linalg.det([[1, x1, y1], [1, x2, y2], [1, x3, y3]])) / self.length

    def printed_normal(self):
        """Eq. 31: forces on P1, P2, P3 per unit of the spring's."""
        (x1, y1), (x2, y2), (x3, y3) = self.p1, self.p2, self.p3
        return np.array([y2 - y3, x3 - x2, y3 - y1, x1 - x3, y1 - y2, x2 - x1]) / self.length

    def gradient(self):
        """Of normal_gap, by central differences."""
        step = 1e-6
        unit = np.eye(6) * step
        return np.array([(self.normal_gap(u) - self.normal_gap(-u)) / (2 * step) for u in unit])

    def shear_couple(self):
        """Moment of the two forces of Eq. 35, t on P1 and -t on P0, per unit of the spring's force."""
        t = (self.p3 - self.p2) / self.length
        r = self.p1 - self.p0
        return float(r[0] * t[1] - r[1] * t[0])


def leapfrog_distance(acceleration, step, steps, half_back):
    """Distance from rest under a constant acceleration; half_back: started with v_{-1/2} = -a h/2, else with 0."""
    v = -0.5 * acceleration * step if half_back else 0.0
    x = 0.0
    for _ in range(steps):
        v += acceleration * step
        x += step * v
    return x


def velocity_error(step, printed):
    """Largest error of v_{n+1} of a unit oscillator over a period, by Eq. 13 as printed or with the new acceleration."""
    steps = round(2.0 * np.pi / step)
    x, half, worst = 1.0, 0.5 * step, 0.0   # x = cos t: v = 0, a = -1, v_{-1/2} = h/2
    for n in range(steps):
        old = -x
        half += step * old
        x += step * half
        velocity = half + 0.5 * step * (old if printed else -x)
        worst = max(worst, abs(velocity + np.sin((n + 1) * step)))
    return float(worst)


def friction_jitter(slope, friction, step, gravity=9.8, steps=1000):
    """Largest speed of a block that should stick, under friction of full size and the sign of the last movement."""
    drive = gravity * np.sin(slope)
    full = gravity * np.cos(slope) * np.tan(friction)
    v = worst = 0.0
    for n in range(steps):
        v += step * (drive - full * np.sign(v))
        if n > 1:
            worst = max(worst, abs(v))
    return float(worst)
