"""The intake with an orientation: what the ingestion node publishes as `imu/data`."""

from pdr_core.attitude import UnjudgedQuaternionFilter
from pdr_core.intake import Ingestion
from pdr_core.params import Params
from pdr_core.records import AttitudeBlock, ImuBlock, Notice


class OrientedIntake:
    """Samples in; trustworthy samples and the orientation at each out. Nobody has judged yet when the foot stands."""

    def __init__(self, params: Params) -> None:
        self._intake = Ingestion(params.intake)
        self._orientation = UnjudgedQuaternionFilter(params)

    def run(self, raw: ImuBlock) -> tuple[ImuBlock, AttitudeBlock]:
        """Return what can be used of these samples and of those that waited, with the orientation at each."""
        return self._oriented(self._intake.run(raw))

    def finish(self) -> tuple[ImuBlock, AttitudeBlock]:
        """Return the samples that still wait for later ones."""
        return self._oriented(self._intake.finish())

    def _oriented(self, imu: ImuBlock) -> tuple[ImuBlock, AttitudeBlock]:
        return imu, self._orientation.run(imu)

    @property
    def notices(self) -> list[Notice]:
        """What was wrong with the samples so far."""
        return self._intake.notices

    @property
    def orientation_notices(self) -> list[Notice]:
        """What was wrong with the orientation so far, which no estimate of the track is made from."""
        return self._orientation.notices
