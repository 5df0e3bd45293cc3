"""What fills the cache walks through the modes in which things happen that two samples do not reach."""

import json
import subprocess
import sys

from pdr_core.records_power import Mode
from pdr_core.warmup import walk_without_gyro


def test_the_gyro_goes_off_and_on_again_in_a_clean_field():
    walked = walk_without_gyro()
    modes = [command.mode for command in walked.commands]
    assert modes[:3] == [Mode.INITIALISING, Mode.DEAD_RECKONING, Mode.SUSPICION]
    assert modes.count(Mode.DEAD_RECKONING) > 1


WITHOUT_GYRO = """
import json, sys
from pdr_core.gait import stance_heading, step_length_calibration, stride_track, turn_suspicion, unseen_stands
from pdr_core.pipeline import gait_watch
from pdr_core.warmup import warm_up
warm_up(adaptive=True)
functions = [gait_watch.watched, stride_track.stride, stride_track.stand, stride_track.take_heading]
functions += [unseen_stands.field_about, stance_heading.shown, turn_suspicion.told, step_length_calibration.combined]
sys.stdout.write(json.dumps({f.__name__: len(f.signatures) for f in functions}))
"""


def test_what_a_node_calls_without_the_gyro_is_there_before_its_first_stride():
    """Else it stands still in mid-walk: two samples reach no stride, and no walk a runner's stand."""
    told = subprocess.run([sys.executable, "-c", WITHOUT_GYRO], capture_output=True, text=True, check=True)
    assert set(json.loads(told.stdout).values()) == {1}
