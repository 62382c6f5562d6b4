"""How much is computed: the full report, or a small one that a test can afford."""
import dataclasses


@dataclasses.dataclass(frozen=True)
class Settings:
    """Sizes, durations and steps of all sections. Times in s."""

    quick: bool
    cavern_duration: float          # paper: 0.01
    cavern_tries: tuple             # steps tried for the implicit method
    rotation_step: float            # of the implicit method
    period_sides: tuple             # blocks along a side of the squares that are timed over whole periods
    start_sides: tuple              # and of those of which only the start is timed, explicit methods alone
    consistent_up_to: int           # longest of the latter for the consistent mass
    accuracy_sides: tuple           # where the step for a given accuracy is looked for
    accuracy_tries: tuple           # implicit steps tried there
    reference_safety: float         # of the critical step, for the reference
    large: int                      # blocks from which slopes are fitted
    start: float                    # part of a period that counts as its start
    rest_sides: tuple
    rest_periods: float             # longest explicit run to rest, in periods
    rest_tries: tuple               # steps of the static variant that are tried
    sliver_side: int                # side in m of the upright square
    polygons: int                   # random polygons whose inertia is looked at


FULL = Settings(
    quick=False, cavern_duration=0.01, cavern_tries=(1e-5, 2e-5, 5e-5, 1e-4, 2e-4, 5e-4), rotation_step=1e-4,
    period_sides=(10, 18, 32, 55, 100, 142), start_sides=(32, 55, 100, 142, 224, 316), consistent_up_to=142,
    accuracy_sides=(10, 18, 32, 55), accuracy_tries=(2e-5, 5e-5, 1e-4, 2e-4, 5e-4), reference_safety=0.1,
    large=1000, start=0.0625, rest_sides=(10, 18, 32, 55), rest_periods=9.0, rest_tries=(1e-3, 1e-2, 1e-1, 1.0),
    sliver_side=30, polygons=2000)

QUICK = Settings(
    quick=True, cavern_duration=2e-4, cavern_tries=(1e-5, 2e-5), rotation_step=1e-3,
    period_sides=(6, 10, 18), start_sides=(10, 18), consistent_up_to=18,
    accuracy_sides=(6, 10), accuracy_tries=(2e-5, 1e-4), reference_safety=0.2,
    large=100, start=0.125, rest_sides=(6, 10), rest_periods=9.0, rest_tries=(1e-2, 1e-1),
    sliver_side=10, polygons=100)
