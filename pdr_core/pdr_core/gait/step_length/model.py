"""The contract of a step length model.

It is linear in its coefficients,

    d = sum_j K_j t_j(stride),

where d [m] is the horizontal length of a stride of one foot: two steps of the person. The terms t_j are figures of the
stride, the coefficients K_j are the person's. Most papers print their model for a step of the body; for a foot that
carries the sensor only strides are seen, and with constant coefficients nothing changes but their size.

A model says what its coefficients usually are. The first term matters most: the others are held at their priors before
it is.
"""

from collections.abc import Callable
from dataclasses import dataclass

from pdr_core.records import Floats
from pdr_core.records_gait import GaitStep


@dataclass(frozen=True)
class Model:
    """One model; `prior` and `prior_sd` are in the order of the terms, which is that of their importance."""

    name: str
    formula: str
    terms: Callable[[GaitStep], Floats]  # (k,)
    prior: tuple[float, ...]
    prior_sd: tuple[float, ...]
