"""Exact answers that no test works out: limits between which a test can only bracket."""
import itertools
import math


def arch_limit(voussoirs):
    """Smallest t/R of a semicircular arch of equal voussoirs that can stand, R being its centre line.

    It stands where some thrust line stays within it: |M| <= N t/2 at every joint. By symmetry the half arch is left
    with two unknowns, thrust and its moment at the crown, in which all conditions are linear.
    """
    low, high = 0.01, 0.5
    while high - low > 1e-7:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if _can_stand(voussoirs, middle) else (middle, high)
    return 0.5 * (low + high)


def _can_stand(voussoirs, t, slack=1e-12):
    """Whether an arch of radius 1 can; by the corners of what all conditions allow."""
    lines = list(_conditions(voussoirs, t))
    for (a, b, c), (d, e, f) in itertools.combinations(lines, 2):
        bottom = a * e - b * d
        if abs(bottom) < slack:
            continue
        thrust, moment = (c * e - b * f) / bottom, (a * f - c * d) / bottom
        if all(p * thrust + q * moment <= r + slack for p, q, r in lines):
            return True
    return False


def _conditions(voussoirs, t):
    """a H + b M <= c for either face of every joint of the right half, in units of rho g R^2; M is about the crown."""
    part = math.pi / voussoirs                      # angle of a voussoir
    area = t * part
    centre = 2.0 * math.sin(part / 2) * (1.0 + t * t / 12.0) / part  # radius of its centroid
    for joint in range(voussoirs // 2 + 1):
        angle = joint * part                        # from the crown
        x, y = math.sin(angle), math.cos(angle)
        arms = [x - centre * math.sin((k + 0.5) * part) for k in range(joint)]
        weight, turning = area * joint, area * sum(arms)
        # About the joint's middle: M + H (1 - y) - turning; normal force H cos + W sin.
        for sign in (1.0, -1.0):
            yield (sign * (1.0 - y) - 0.5 * t * math.cos(angle), sign,
                   sign * turning + 0.5 * t * weight * math.sin(angle))
