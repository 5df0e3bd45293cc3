"""What a person wants to know of the steps of one foot: the same, whether the filter or the smoother found them."""

from pdr_core.gait import StrideAnalysis
from pdr_core.pipeline.foot_inertial import FootOutput
from pdr_core.records import Notice
from pdr_core.records_gait import Mounting, Stride


class FootGait:
    """Takes every output of a pipeline once, in order, and gives out strides."""

    def __init__(self) -> None:
        self._analysis = StrideAnalysis()

    def run(self, output: FootOutput) -> list[Stride]:
        """Return the strides that are known with this output."""
        return self._analysis.run(output.judged, output.nav, output.steps)

    def finish(self) -> list[Stride]:
        """Return the strides that still wait: there will be no more output."""
        return self._analysis.finish()

    @property
    def mounting(self) -> Mounting | None:
        """How the sensor sits on the foot, beyond what the intake was told; None: not known."""
        return self._analysis.mounting

    @property
    def notices(self) -> list[Notice]:
        """What could not be told."""
        return self._analysis.notices
