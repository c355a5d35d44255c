# SPDX-License-Identifier: MIT
"""How far a median of rounds may be off: rounds are drawn again, with replacement, and the middle
99 % of the medians so found are the interval (bootstrap, its random numbers fixed). With five
rounds or fewer it is all but the range of the rounds; with fewer than three nothing is judged."""

from functools import cache
from statistics import median
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Times = NDArray[np.float64]

LEAST_ROUNDS = 3
SHARE = 99  # per cent of the medians that the interval holds
_DRAWS = 2000


class Estimate(NamedTuple):
    """The median over the rounds, and its interval."""

    median: float
    low: float
    high: float
    rounds: int

    @property
    def judged(self) -> bool:
        return self.rounds >= LEAST_ROUNDS

    def above(self, limit: float) -> bool:
        """Beyond the noise of the rounds."""
        return self.judged and self.low > limit

    def below(self, limit: float) -> bool:
        return self.judged and self.high < limit


def ratios(above: tuple[float, ...], below: tuple[float, ...]) -> tuple[float, ...]:
    """Of the rounds that both have; without those in which the latter took no time."""
    return tuple(a / b for a, b in zip(above, below, strict=False) if b > 0)


@cache
def estimate(values: tuple[float, ...], share: float = SHARE) -> Estimate:
    """Of one value a round; there must be one."""
    drawn = drawn_medians(values, np.random.default_rng(1))
    return Estimate(median(values), *middle(drawn, share), len(values))


def drawn_medians(times: tuple[float, ...], random: np.random.Generator) -> Times:
    drawn = random.integers(0, len(times), size=(_DRAWS, len(times)))
    medians: Times = np.median(np.asarray(times)[drawn], axis=1)
    return medians


def middle(values: Times, share: float = SHARE) -> tuple[float, float]:
    """Where the middle share begins and ends."""
    edges = (100 - share) / 2, (100 + share) / 2
    low, high = np.nanpercentile(values, edges, method="inverted_cdf")
    return float(low), float(high)
