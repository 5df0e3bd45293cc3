"""Heading with the gyro off: tilt by the accelerometer of a standing foot, azimuth by its magnetic field (Zhou 2.2).

While the gyro is on, each stand shows where the field points in the world: north. Where strength, dip and azimuth of
the last places agree, the field is clean; these are the criteria of `eskf/field_places.py`, with the same parameters.
With the gyro off nobody sees the azimuth in the world. A place counts as clean whose field has the strength and the
dip of that in which north was found, after as many such places in a row as found it: iron bends all three at once, and
differently from place to place.

Elsewhere the field is a bad compass, and how bad the first places have shown: in buildings its azimuth scatters by 10
to 30 deg. It is still worth more than a heading that is held, for a person turns by as much in a stride, and
the field's error does not grow (measured on real walks with the gyro off: end error 20 to 40 % of the distance with it,
140 % without). So a heading is told there too, with that deviation.

Fields are off in two ways: each place by itself, and all places of a neighbourhood together, which no number of
places averages out. A heading says both. The up of a standing foot is off by some tenths of a degree, and the
heading by the tangent of the dip times as much: `field_heading_sd_rad` has that in it.
"""

from collections import deque
from math import isfinite, nan, pi
from typing import NamedTuple

import numpy as np

from pdr_core.gait.stands import Stand
from pdr_core.maths.circular import circular_mean_rad, wrapped_rad
from pdr_core.maths.compiled import compiled
from pdr_core.maths.magnetic import alike, alike_angles, azimuth_rad, dip_rad, level_field, same_field
from pdr_core.maths.vector import norm
from pdr_core.params import DeadReckoningParams, FilterParams
from pdr_core.records import Floats
from pdr_core.records_gait import Angle, FieldHeading

PLACES = 12  # that are compared to judge the field, as in the filter
REMEMBERED = 50  # places that tell north in a disturbed field
USELESS_RAD = 1.0  # a larger scatter tells no direction: evenly spread it would be 1.8


class Field(NamedTuple):
    """The field at a stand."""

    norm_tesla: float
    dip_rad: float
    azimuth_rad: float  # counter-clockwise from the foot's heading


NO_FIELD = Field(nan, nan, nan)


class North(NamedTuple):
    """The clean field in which north was found; its azimuth counts counter-clockwise from x of the world."""

    norm_tesla: float
    dip_rad: float
    azimuth_rad: float


def field_of(stand: Stand) -> Field | None:
    """Return the field at a stand; None of none."""
    seen = Field(*shown(stand.force_mps2, stand.field_tesla)) if stand.field_seen else NO_FIELD
    return seen if isfinite(sum(seen)) else None


@compiled
def shown(up: Floats, field_tesla: Floats) -> tuple[float, float, float]:
    """Return the norm of a field, its dip and its azimuth, counter-clockwise from the foot's heading; NaN: of none."""
    norm_tesla = norm(field_tesla)
    if not (norm_tesla > 0.0 and norm(up) > 0.0):
        return np.nan, np.nan, np.nan
    return norm_tesla, dip_rad(up, field_tesla), azimuth_rad(level_field(up, field_tesla))


class StanceHeading:
    """Learns north while the gyro is on; tells the foot's heading, and how well, while it is off."""

    def __init__(self, clean: FilterParams, params: DeadReckoningParams) -> None:
        self._clean = clean
        self._params = params
        self._places: deque[Field] = deque(maxlen=REMEMBERED)  # the azimuth is that in the world
        self._north: North | None = None
        self._agreeing = 0  # places in a row that have the field of north

    def learn(self, stand: Stand, yaw: Angle) -> None:
        """Take a stand at which the filter knows the yaw of the foot."""
        field = field_of(stand)
        if field is None or not np.isfinite(yaw).all():
            return
        self._places.append(field._replace(azimuth_rad=wrapped_rad(yaw.rad + field.azimuth_rad)))
        norms, dip, azimuth = np.array(self._places)[-PLACES:].T
        clean = (
            len(self._places) >= PLACES
            and alike(norms / norms.mean(), self._clean.field_norm_tolerance)
            and alike(dip, self._clean.field_dip_tolerance_rad)
            and alike_angles(azimuth, self._clean.field_azimuth_tolerance_rad)
        )
        self._agreeing = PLACES if clean else 0
        if clean:
            self._north = North(float(norms.mean()), float(dip.mean()), circular_mean_rad(azimuth))

    @property
    def clean(self) -> bool:
        """The last places, enough of them, have the field in which north was found."""
        return self._north is not None and self._agreeing >= PLACES

    def heading(self, stand: Stand) -> FieldHeading | None:
        """Return the yaw of the foot at a stand with the gyro off; None: there is no field, or it tells nothing."""
        field = field_of(stand)
        if field is None:
            return None
        self._agreeing = self._agreeing + 1 if self._like_north(field) else 0
        if self._north and self.clean:
            sd_rad = self._clean.field_heading_sd_rad
            return FieldHeading(wrapped_rad(self._north.azimuth_rad - field.azimuth_rad), sd_rad, sd_rad)
        return self._disturbed(field)

    def _disturbed(self, field: Field) -> FieldHeading | None:
        """Return the heading by all places of the memory, as uncertain as they differ."""
        if len(self._places) < PLACES:
            return None
        azimuths = [place.azimuth_rad for place in self._places]
        north_rad = circular_mean_rad(azimuths)
        scatter_rad = float(np.sqrt(np.mean([wrapped_rad(a - north_rad) ** 2 for a in azimuths])))
        if scatter_rad > USELESS_RAD:
            return None
        sd_rad = min(pi, max(scatter_rad, self._params.field_disturbed_sd_rad))
        return FieldHeading(wrapped_rad(north_rad - field.azimuth_rad), sd_rad, self._params.field_common * sd_rad)

    def _like_north(self, field: Field) -> bool:
        north, p = self._north, self._clean
        return north is not None and bool(
            same_field(*field[:2], *north[:2], p.field_norm_tolerance, p.field_dip_tolerance_rad)
        )
