"""Partial duty: the ground between a gyro that is always on and one that is always off."""

from pdr_core.params import PowerParams


def gyro_wanted(params: PowerParams, strides: int) -> bool:
    """Return whether the gyro shall be on in dead reckoning after so many strides of it.

    With `strides` it is off for the first n - k of every n strides and on for the last k.
    """
    if params.duty != "strides":
        return False
    on, of = params.duty_on_strides, params.duty_of_strides
    return strides % of >= of - min(on, of)
