"""What the mode manager remembers of a walk, and the conditions of Zhou's Tables 1-3 as questions to it."""

import math
from dataclasses import dataclass, field

from pdr_core.conventions import NO_STAMP, nanoseconds
from pdr_core.params import PowerParams
from pdr_core.records_gait import Behaviour
from pdr_core.records_power import MeasuredStride, Walk

GAITS = (Behaviour.WALKING, Behaviour.RUNNING)
MOVING = (*GAITS, Behaviour.SWING)


@dataclass
class Memory:
    """What was seen so far. A question is about the moment of the newest record."""

    params: PowerParams
    walk: Walk | None = None  # the newest record
    gait: Behaviour = Behaviour.UNKNOWN  # walked last
    gait_before: Behaviour = Behaviour.UNKNOWN  # walked when the gyro went off
    walked_m: dict[Behaviour, float] = field(default_factory=dict)  # by the filter
    behaves_ns: int = NO_STAMP  # since when the behaviour is what it is
    examined_ns: int = NO_STAMP  # the last stride that fitted, or when the calibration ended
    settled_ns: int = NO_STAMP  # from then on the gyro's rates can be trusted; NO_STAMP: it is off
    fit: bool | None = None  # of the strides measured in this mode; None: none was
    calm: int = 0  # strides in a row without a turn
    strides: int = 0  # since dead reckoning began

    def see(self, walk: Walk) -> None:
        """Take a record."""
        if self.walk and walk.stamp_ns < self.walk.stamp_ns:
            self._turn_back(walk.stamp_ns - self.walk.stamp_ns)
        if self.walk is None or walk.behaviour is not self.walk.behaviour:
            self.behaves_ns = walk.stamp_ns
        self.walk = walk
        if walk.behaviour in GAITS:
            self.gait = walk.behaviour
        self._count(walk)
        for stride in walk.strides:
            self._measure(stride)

    def begin(self, gyro: bool, keeps_examination: bool) -> None:
        """Begin a mode."""
        self.fit, self.calm, self.strides = None, 0, 0
        if not gyro:
            self.gait_before = self.gait
        if not keeps_examination and self.walk:
            self.examined_ns = self.walk.stamp_ns

    def forget_calibration(self) -> None:
        """Calibrate the gait walked last anew, over the whole of L0."""
        self.walked_m[self.gait] = 0.0

    @property
    def calibrated(self) -> bool:
        """L >= L0, and the step length model is good (Table 2)."""
        walked_m = self.walked_m.get(self.gait, 0.0)
        return self._seen.model_ready and walked_m >= self.params.calibration_m

    @property
    def walks(self) -> bool:
        """The person walks or runs."""
        return self._seen.behaviour in GAITS

    @property
    def rests(self) -> bool:
        """The foot has stood for long enough for the gyro to go off (Table 1).

        Not before the first rest has told the gyro bias, and only where a model reckons the step that ends the rest: it
        is over before a gyro that it wakes can be trusted. A sensor that switches by itself sees to it in any mode.
        """
        stands = self._has_been(Behaviour.STANDING, self.params.stand_s)
        return stands and self._seen.rest_tested and self.calibrated and not self.swings

    @property
    def swings(self) -> bool:
        """The sensor shall switch its gyro in each swing."""
        return self.params.duty == "swing"

    @property
    def moves(self) -> bool:
        """The foot does not stand."""
        return self._seen.behaviour in MOVING

    @property
    def new_behaviour(self) -> bool:
        """What the foot does has no calibrated model (Table 2). Moving may be the first stride of a walk."""
        return self._has_been(Behaviour.SWING, self.params.swing_s) or (self.walks and not self.calibrated)

    @property
    def changed(self) -> bool:
        """The gait is another one than when the gyro went off, and has a calibrated model."""
        return self.walks and self.gait is not self.gait_before

    @property
    def turns(self) -> bool:
        """A turn is suspected, and would be missed."""
        return self._seen.turn_suspected and not self.swings

    @property
    def calm_again(self) -> bool:
        """No turn is suspected any more."""
        return self.calm >= self.params.calm_strides

    @property
    def examination_due(self) -> bool:
        """T0 has passed since the step length model was examined (Table 1)."""
        return self.walks and self._seen.stamp_ns - self.examined_ns >= nanoseconds(self.params.examine_every_s)

    @property
    def fits(self) -> bool:
        """The measured stride fits the model: |d_KF - d_SL| <= 3 sigma_d (Table 3)."""
        return self.fit is True

    @property
    def misfits(self) -> bool:
        """It does not."""
        return self.fit is False

    @property
    def _seen(self) -> Walk:
        if self.walk is None:
            raise ValueError("a question before the first record")
        return self.walk

    def _has_been(self, behaviour: Behaviour, time_s: float) -> bool:
        walk = self._seen
        return walk.behaviour is behaviour and walk.stamp_ns - self.behaves_ns >= nanoseconds(time_s)

    def _count(self, walk: Walk) -> None:
        taken = walk.reckoned + len(walk.strides)
        self.strides += taken
        self.calm = 0 if walk.turn_suspected else self.calm + taken

    def _measure(self, stride: MeasuredStride) -> None:
        """Take a stride that the filter has measured, if all of it was measured."""
        if self.settled_ns == NO_STAMP or stride.start_ns < self.settled_ns or not math.isfinite(stride.filter_m):
            return
        self.walked_m[self.gait] = self.walked_m.get(self.gait, 0.0) + stride.filter_m
        if math.isfinite(stride.model_m) and stride.model_sd_m > 0.0:
            self.fit = abs(stride.filter_m - stride.model_m) <= self.params.examine_sd * stride.model_sd_m
            self.examined_ns = stride.stamp_ns if self.fit else self.examined_ns

    def _turn_back(self, jump_ns: int) -> None:
        """Follow a clock that has jumped back: stamps of the time before would lie in the future."""
        for name in ("behaves_ns", "examined_ns", "settled_ns"):
            stamp_ns = getattr(self, name)
            if stamp_ns != NO_STAMP:
                setattr(self, name, stamp_ns + jump_ns)
