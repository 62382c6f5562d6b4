"""Exact answers: sliding, rocking, toppling."""
import math

import numpy as np


def sliding(angle, friction, gravity, time):
    """Eq. 42: distance slid from rest on a slope of `angle` degrees."""
    a, phi = math.radians(angle), math.radians(friction)
    return 0.5 * gravity * time ** 2 * (math.sin(a) - math.tan(phi) * math.cos(a))


def falling_time(start, end, p2, nodes=200):
    """Time from rest at `start` to `end` (rad) of psi'' = p2 sin(psi), an upside-down pendulum.

    psi' = sqrt(2 p2 (cos start - cos psi)); with psi = start + u^2 the integrand 2 u/psi' is smooth, and
    Gauss-Legendre quadrature exact to rounding.
    """
    sign = 1.0 if end > start else -1.0
    x, w = np.polynomial.legendre.leggauss(nodes)
    top = math.sqrt(abs(end - start))
    u = 0.5 * top * (x + 1.0)
    psi = start + sign * u ** 2
    # cos a - cos b = 2 sin((b + a)/2) sin((b - a)/2), without cancellation
    drop = 2.0 * np.sin(0.5 * (psi + start)) * np.sin(0.5 * (psi - start))
    return float(0.5 * top * np.sum(w * 2.0 * u / np.sqrt(2.0 * p2 * drop)))


class Standing:
    """A block on its corner as a rigid pendulum; psi is the angle of its centre beyond the corner, 0 at balance."""

    def __init__(self, width, height, gravity):
        self.balance = math.atan2(width, height)        # tilt at which the centre stands above the corner
        self.radius = 0.5 * math.hypot(width, height)   # from corner to centre
        self.gyration2 = (width ** 2 + height ** 2) / 12.0  # J/M
        self.gravity = gravity

    def p2(self, gyration2=None):
        """g R/(J/M + R^2), 1/s2."""
        k2 = self.gyration2 if gyration2 is None else gyration2
        return self.gravity * self.radius / (k2 + self.radius ** 2)

    def slower(self, gyration2):
        """How many times longer everything takes with another J/M."""
        return math.sqrt(self.p2() / self.p2(gyration2))

    def quarter_period(self, tilt):
        """From rest at `tilt` to flat."""
        return falling_time(tilt - self.balance, -self.balance, self.p2())

    def toppling_time(self, start, end):
        """From rest at psi = start to psi = end, both beyond the balance."""
        return falling_time(start, end, self.p2())

    def path(self, tilt, times, gyration2=None):
        """Tilt over time from rest, by Runge-Kutta, for figures."""
        p2 = self.p2(gyration2)
        psi, rate, now, out = tilt - self.balance, 0.0, 0.0, []
        for time in times:
            steps = max(1, math.ceil((time - now) / 1e-4))
            h = (time - now) / steps
            for _ in range(steps):
                k1 = p2 * math.sin(psi)
                k2 = p2 * math.sin(psi + 0.5 * h * rate)
                k3 = p2 * math.sin(psi + 0.5 * h * rate + 0.25 * h * h * k1)
                k4 = p2 * math.sin(psi + h * rate + 0.5 * h * h * k2)
                psi += h * rate + h * h * (k1 + k2 + k3) / 6.0
                rate += h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0
            now = time
            out.append(psi + self.balance)
        return out


def crossing(times, values, level):
    """First time at which `values` crosses `level`, linear between rows; None if it never does."""
    above = np.asarray(values) > level
    change = np.nonzero(above[1:] != above[:-1])[0]
    if len(change) == 0:
        return None
    k = int(change[0])
    part = (level - values[k]) / (values[k + 1] - values[k])
    return float(times[k] + part * (times[k + 1] - times[k]))
