"""The magnetometer of one sensor: raw fields in, calibrated fields in the foot's axes out; the rest stays as it is."""

import numpy as np

from pdr_core.intake import field_rules
from pdr_core.intake.field_plausibility import MAG_UNITS, FieldPlausibility
from pdr_core.intake.field_rules import ABSURD, REPEATED, SATURATED, STUCK, FieldLimits, Fields, calibrated, holds_field
from pdr_core.notices import Tally
from pdr_core.params import IntakeParams
from pdr_core.records import Floats, ImuBlock, Level, Notice

SAID = {
    ABSURD: ("mag_absurd", "magnetic fields are no numbers or beyond any range: left out; check intake.mag_unit"),
    SATURATED: ("mag_saturated", "the magnetometer saturates: choose a larger range, or keep it away from iron"),
    STUCK: ("mag_stuck", "the magnetometer shows one value while it turns: left out; restart it, check its wiring"),
}


class Magnetometer:
    """Calibrates fields and leaves out what is no measurement; of a sample at most its field is lost."""

    def __init__(self, params: IntakeParams, R_foot_from_sensor: Floats) -> None:
        self._limits = FieldLimits(
            MAG_UNITS[params.mag_unit],
            offset_tesla(params),
            R_foot_from_sensor @ matrix(params),
            params.mag_sd_tesla,
            params.mag_range_tesla,
        )
        self._state = field_rules.fresh_state()
        self._shown = False  # any field
        self._plausibility = FieldPlausibility(params.mag_unit)
        self._tally = Tally()

    def run(self, block: ImuBlock) -> ImuBlock:
        """Return the samples with their fields calibrated, in tesla and the foot's axes."""
        self._shown = self._shown or holds_field(block)
        if not self._shown:
            return block
        fields = calibrated(block, self._limits, self._state)
        self._tell(block, fields)
        return block._replace(field_tesla=fields.field_tesla, field_sd_tesla=fields.sd_tesla)

    @property
    def notices(self) -> list[Notice]:
        """What was wrong with the fields so far."""
        return self._tally.notices

    def _tell(self, block: ImuBlock, fields: Fields) -> None:
        if (fields.verdict > REPEATED).any():
            for verdict, (kind, text) in SAID.items():
                self._tally.add_flagged(kind, Level.WARN, text, fields.verdict == verdict, block.stamp_ns)
        self._plausibility.watch(block.stamp_ns, fields.shown_tesla, self._tally)


def offset_tesla(p: IntakeParams) -> Floats:
    """Return the hard iron, (3,)."""
    return np.array([p.mag_offset_x_tesla, p.mag_offset_y_tesla, p.mag_offset_z_tesla])


def matrix(p: IntakeParams) -> Floats:
    """Return soft iron, scale and axes, (3, 3): calibrated = matrix (field - offset), in the axes of the gyro."""
    return np.array(
        [
            [p.mag_matrix_xx, p.mag_matrix_xy, p.mag_matrix_xz],
            [p.mag_matrix_yx, p.mag_matrix_yy, p.mag_matrix_yz],
            [p.mag_matrix_zx, p.mag_matrix_zy, p.mag_matrix_zz],
        ]
    )
