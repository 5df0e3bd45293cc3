"""What is not known at all leaves as a large number that other filters can compute with."""

import numpy as np

from pdr_nodes.covariance import LARGEST_POSE, bounded

COVARIANCE = np.cov(np.random.default_rng(2).standard_normal((6, 40)))


def test_what_is_small_enough_stays_as_it_is():
    assert bounded(COVARIANCE, LARGEST_POSE) is COVARIANCE


def test_what_is_too_large_keeps_its_correlations_and_stays_a_covariance():
    grown = COVARIANCE * np.outer(scale := np.array([1e9, 1e140, 1.0, 1.0, 1.0, 1e3]), scale)
    small = bounded(grown, LARGEST_POSE)
    sd, before = np.sqrt(np.diag(small)), np.sqrt(np.diag(COVARIANCE))
    np.testing.assert_allclose(sd[[0, 1, 5]], np.sqrt(LARGEST_POSE[[0, 1, 5]]))
    np.testing.assert_allclose(sd[[2, 3, 4]], before[[2, 3, 4]])
    np.testing.assert_allclose(small / np.outer(sd, sd), COVARIANCE / np.outer(before, before), atol=1e-12)
