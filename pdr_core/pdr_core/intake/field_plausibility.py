"""Does the first second of a magnetometer look like the Earth's field? Names wrong units and iron nearby."""

import numpy as np

from pdr_core.conventions import EARTH_FIELD_TESLA
from pdr_core.intake.first_look import FirstLook
from pdr_core.notices import Tally
from pdr_core.records import Floats, Level, Stamps

MAG_UNITS = {"T": 1.0, "uT": 1e-6, "nT": 1e-9, "G": 1e-4, "mG": 1e-7}
CREDIBLE_TESLA = (10e-6, 150e-6)  # with the iron of a shoe or a room


class FieldPlausibility:
    """Looks at the first second of fields."""

    def __init__(self, unit: str) -> None:
        self._unit = unit
        self._first_look = FirstLook()

    def watch(self, stamp_ns: Stamps, shown_tesla: Floats, tally: Tally) -> None:
        """Look at how strong the next fields are, (n,), 0 where there is none; tell the tally what is not plausible."""
        if self._first_look.over:
            return
        there = np.isfinite(shown_tesla) & (shown_tesla > 0.0)
        norm_tesla = self._first_look.typical(stamp_ns[there], shown_tesla[there])
        if norm_tesla is not None:
            self._tell(norm_tesla, tally)

    def _tell(self, norm_tesla: float, tally: Tally) -> None:
        if CREDIBLE_TESLA[0] <= norm_tesla <= CREDIBLE_TESLA[1]:
            return
        unit = probable_unit(norm_tesla / MAG_UNITS[self._unit])
        measured = f"the magnetic field is typically {norm_tesla * 1e6:.3g} uT; the Earth's is 22 to 67"
        if unit:
            text = f"{measured}: probably in {unit}; set intake.mag_unit, or the unit in the column map, to {unit}"
            tally.add("mag_unit", Level.ERROR, text, self._first_look.start_ns)
        else:
            text = f"{measured}: not calibrated, or iron is near; run `pdr calibrate mag`"
            tally.add("mag_uncalibrated", Level.WARN, text, self._first_look.start_ns)


def probable_unit(norm: float) -> str:
    """Return the unit in which a field of such a strength is the Earth's, or nothing."""
    fits = (unit for unit, tesla in MAG_UNITS.items() if EARTH_FIELD_TESLA[0] <= norm * tesla <= EARTH_FIELD_TESLA[1])
    return next(fits, "")
