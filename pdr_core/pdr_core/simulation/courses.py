"""The courses of the named walks."""

from dataclasses import replace

import numpy as np

from pdr_core.parameter import ParameterError
from pdr_core.simulation.campus import campus
from pdr_core.simulation.foot_motion import REST_S
from pdr_core.simulation.gait import (
    RISE_M,
    RUN,
    SHUFFLE,
    STAIRS_DOWN,
    STAIRS_UP,
    STATURE_M,
    STROLL,
    SWING,
    WALK,
    Gait,
    Stride,
)
from pdr_core.simulation.gui_motion import STEP_LENGTH_M, GuiCourse, Phase, step, steps, turn
from pdr_core.simulation.motion import Course
from pdr_core.simulation.qiu_courses import LAP_M, qiu_rectangle, stair_climb, track
from pdr_core.simulation.zhou_courses import octagon, transitions

FLIGHT = 9  # strides from one floor to the next: 3.06 m
CORNER = 3  # strides of a walked turn by 90 degrees
CORRIDOR_CORNER, CORRIDOR_STRIDE_M = 2, 0.9  # and in a corridor: a radius of 1.2 m
ROUND = 12  # least strides of a walked circle
STAND_S = 2.0


def gui_course(name: str, length_m: float) -> Course:
    """Return Gui's motion along a walk of about `length_m`, in whole steps; ParameterError if it has no such walk."""
    if name == "still":
        phases = []
    elif name == "straight":
        phases = steps(max(1, round(length_m / STEP_LENGTH_M)))
    elif name == "rectangle":
        phases = gui_rectangle(length_m)
    elif name == "campus":
        phases = [phase for pace in campus(length_m, STEP_LENGTH_M) for phase in step(pace.length_m, pace.turn_rad)]
    else:
        known = "Gui's foot walks only rectangle, straight, still and campus"
        raise ParameterError(f"simulation.walk = '{name}': {known}; set simulation.motion to smooth")
    return GuiCourse([Phase(REST_S), *phases, Phase(REST_S)])


def gui_rectangle(length_m: float) -> list[Phase]:
    """Return Gui's steps and turns on the spot round a rectangle of about `length_m`."""
    long_side, short_side = sides(length_m, STEP_LENGTH_M)
    corner = turn(np.pi / 2.0)
    return (steps(long_side) + corner + steps(short_side) + corner) * 2


def sides(length_m: float, stride_m: float) -> tuple[int, int]:
    """Return the strides along the long and the short side of a rectangle whose circumference is about `length_m`."""
    long_side = max(1, round(length_m / stride_m / 3.0))
    return long_side, max(1, round(length_m / stride_m / 2.0) - long_side)


def strides(name: str, length_m: float, pace: float, stature_m: float = STATURE_M) -> list[Stride]:
    """Return the strides of a walk of about `length_m`, in whole strides, at `pace` times the usual speed.

    The walks of Zhou are as long whoever walks them; the others get longer with their strides.
    """

    def made(gait: Gait) -> Gait:
        return gait.of_stature(stature_m).paced(pace)

    zhou = {
        "octagon": lambda: octagon(length_m, made(WALK)),
        "octagon_run": lambda: octagon(length_m, made(RUN)),
        "transitions": lambda: transitions(length_m, made(SWING), made(WALK), made(RUN)),
    }
    if name in zhou:
        return zhou[name]()
    return [replace(s, gait=made(s.gait)) for s in usual_strides(name, length_m)]


def usual_strides(name: str, length_m: float) -> list[Stride]:
    """Return the strides of a walk as a person of usual stature and speed makes them."""
    return {
        "still": lambda _: [],
        "campus": lambda length_m: [
            Stride(replace(WALK, length_m=pace.length_m), turn_rad=pace.turn_rad)
            for pace in campus(length_m, WALK.length_m)
        ],
        "straight": lambda length_m: ahead(length_m, WALK),
        "rectangle": rectangle,
        "curve": circle,
        "corridor": corridor,
        "stairs": stairs,
        "run": lambda length_m: ahead(length_m, RUN),
        "mixed": mixed,
        "qiu_rectangle": lambda length_m: qiu_rectangle(round(length_m / STROLL.length_m), length_m),
        "track": lambda length_m: track([round(LAP_M / WALK.length_m)] * max(1, round(length_m / LAP_M))),
        "stair_climb": lambda length_m: stair_climb(ahead(length_m / 2.0, WALK)),
    }[name](length_m)


def ahead(length_m: float, gait: Gait) -> list[Stride]:
    """Return strides straight ahead."""
    return [Stride(gait)] * max(1, round(length_m / gait.length_m))


def walked_turn(angle_rad: float, gait: Gait = WALK, corner: int = CORNER) -> list[Stride]:
    """Return strides along an arc, `corner` of them for 90 degrees."""
    count = max(1, round(abs(angle_rad) * corner / (np.pi / 2.0)))
    return [Stride(gait, turn_rad=angle_rad / count)] * count


def rectangle(length_m: float) -> list[Stride]:
    """Return four sides and four walked corners, which close."""
    long_side, short_side = sides(max(0.0, length_m - 4 * CORNER * WALK.length_m), WALK.length_m)
    corner = walked_turn(np.pi / 2.0)
    return ([Stride(WALK)] * long_side + corner + [Stride(WALK)] * short_side + corner) * 2


def circle(length_m: float) -> list[Stride]:
    """Return one turn to the left along a circle, which closes."""
    count = max(ROUND, round(length_m / WALK.length_m))
    return [Stride(WALK, turn_rad=2.0 * np.pi / count)] * count


def corridor(length_m: float) -> list[Stride]:
    """Return three long parts and two short ones between them: left, right, right and left again.

    The corners are tight, as corridors have them. The long parts are the odd ones; the walk does not close.
    """
    narrow = replace(WALK, length_m=CORRIDOR_STRIDE_M)
    corners = [walked_turn(angle, narrow, CORRIDOR_CORNER) for angle in np.radians([90.0, -90.0, -90.0, 90.0])]
    straight_m = max(0.0, length_m - 4 * CORRIDOR_CORNER * CORRIDOR_STRIDE_M)
    parts = [ahead(straight_m * share, WALK) for share in (0.25, 0.125, 0.25, 0.125, 0.25)]
    return [s for part, corner in zip(parts, [*corners, []], strict=True) for s in part + corner]


def stairs(length_m: float) -> list[Stride]:
    """Return a walk on one floor, a flight up, half a turn, the same length on the next floor, and a flight down."""
    level = ahead(length_m / 2.0, WALK)
    up, down = [Stride(STAIRS_UP, climb_m=RISE_M)] * FLIGHT, [Stride(STAIRS_DOWN, climb_m=-RISE_M)] * FLIGHT
    return [*level, *up, *walked_turn(np.pi), *level, *walked_turn(np.pi), *down]


def mixed(length_m: float) -> list[Stride]:
    """Return a walk, a run, a walked half turn, a stand, a walk with turns both ways, and a shuffle."""
    part_m = length_m / 4.0
    stop = replace(Stride(WALK), pause_s=STAND_S)
    weave = walked_turn(np.pi / 3.0) + walked_turn(-2.0 * np.pi / 3.0) + walked_turn(np.pi / 3.0)
    back = [*walked_turn(np.pi), stop, *ahead(part_m, WALK), *weave]
    return [*ahead(part_m, WALK), *ahead(part_m, RUN), *back, *ahead(part_m / 4.0, SHUFFLE)]
