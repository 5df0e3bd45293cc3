"""One foot whose steps the heading constraint answers, if the parameters want one."""

from pdr_core.heading import HeadingConstraint
from pdr_core.params import Params, changed
from pdr_core.pipeline.foot_inertial import FootInertial
from pdr_core.records import Floats, Notice


def constrains(params: Params) -> bool:
    """Tell whether the parameters want a heading constraint."""
    return params.heading.constraint != "none"


class ConstrainedFoot(FootInertial):
    """`FootInertial` with the constraint of `heading.constraint`; with none it is the same to the last bit."""

    def __init__(self, params: Params, phases_s: Floats | None = None) -> None:
        self._constraint = HeadingConstraint(params.heading)
        asks = params.filter.heading_feedback or constrains(params)
        super().__init__(changed(params, "filter", heading_feedback=asks), self._constraint.answer, phases_s)

    @property
    def notices(self) -> list[Notice]:
        """What was wrong so far, and what the constraint has done."""
        return super().notices + self._constraint.notices
