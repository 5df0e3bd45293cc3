"""Recursive least squares of y = a'K + e with a prior, in the information form, and with a condition check.

Each observation adds w a a' and w a y to sums, w its weight: that is the whole recursion, and it is exact. With prior
values k and deviations s of the coefficients the estimate is the minimum of

    sum w (y - a'K)^2 / r + sum_j ((K_j - k_j) / s_j)^2,

where r says by how much observations scatter more than their weights have it, as variances: r = (m + sum w (y - a'K)^2)
/ (m + n), the weights themselves counting for m observations and n being the observations beyond the coefficients. So
a person who walks evenly is believed sooner. As r depends on the estimate, both are found in turn.

Terms that hardly vary, or vary alike, make that ill-posed. So terms are taken one by one, in their order, and one that
the observations tell no better than its prior is held there. It is a condition number in the units of what is known: a
term that varies by a hundredth, or by a tenth, is told in the end, if there are observations enough.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.records import Flags, Floats

ROUNDS = 4  # r changes by less than a hundredth in the last


class Estimate(NamedTuple):
    """What the observations so far say."""

    coefficients: Floats  # (k,)
    covariance: Floats  # (k, k); zero where a coefficient is held
    held: Flags  # (k,) at its prior
    residual_sd: float  # of one observation; nan: there are no more observations than coefficients


class LeastSquares:
    """The sums of the observations."""

    def __init__(self, prior: Floats, prior_sd: Floats, weights_count: float) -> None:
        """`weights_count`: the deviations given count for so many observations (m)."""
        self._prior, self._prior_sd, self._weights_count = prior, prior_sd, weights_count
        k = len(prior)
        self._aa, self._ay, self._yy = np.zeros((k, k)), np.zeros(k), 0.0
        self._weight = 0.0
        self.count = 0

    def add(self, terms: Floats, value: float, sd: float) -> None:
        """Take one observation with its deviation."""
        weight = 1.0 / sd**2
        self._aa += weight * np.outer(terms, terms)
        self._ay += weight * value * terms
        self._yy += weight * value**2
        self._weight += weight
        self.count += 1

    def estimate(self) -> Estimate:
        """Return the coefficients."""
        scatter = 1.0
        for _ in range(ROUNDS):
            free = self._free(scatter)
            coefficients, covariance = self._solved(free, scatter)
            squares, beyond = self._squares(coefficients), max(self.count - int(free.sum()), 0)
            scatter = (self._weights_count + squares) / (self._weights_count + beyond)
        return Estimate(coefficients, covariance, ~free, self._residual_sd(squares, beyond))

    def _solved(self, free: Flags, scatter: float) -> tuple[Floats, Floats]:
        """Return the coefficients and their covariance, those that are not free at their priors."""
        both = np.ix_(free, free)
        known = (self._ay - self._aa[:, ~free] @ self._prior[~free]) / scatter
        prior_information = self._prior_sd[free] ** -2.0
        information = self._aa[both] / scatter + np.diag(prior_information)
        coefficients, covariance = self._prior.copy(), np.zeros_like(self._aa)
        coefficients[free] = np.linalg.solve(information, known[free] + prior_information * self._prior[free])
        covariance[both] = np.linalg.inv(information)
        return coefficients, covariance

    def _free(self, scatter: float) -> Flags:
        """Return which coefficients, (k,), the observations tell better than their priors."""
        information = self._aa / scatter
        free = np.zeros(len(information), np.bool_)
        for j in range(len(information)):
            explained = information[j, free] @ np.linalg.solve(information[np.ix_(free, free)], information[free, j])
            free[j] = (information[j, j] - explained) * self._prior_sd[j] ** 2 > 1.0
        return free

    def _squares(self, coefficients: Floats) -> float:
        """Return the weighted squares of what the coefficients leave."""
        return max(0.0, float(self._yy - 2.0 * coefficients @ self._ay + coefficients @ self._aa @ coefficients))

    def _residual_sd(self, squares: float, beyond: int) -> float:
        """Return the deviation of an observation from the estimate: Zhou's sigma_d with n - k for his n - 1."""
        return float(np.sqrt(squares / self._weight * self.count / beyond)) if beyond else np.nan
