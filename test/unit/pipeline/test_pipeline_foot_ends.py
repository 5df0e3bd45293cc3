"""One foot's samples end in the middle of the walk: when that is noticed changes nothing, to the last bit."""

import numpy as np
import pytest
from feet_cases import FEET, Messages, Together, samples

from pdr_core.records import joined, part


class Ending(Messages):
    """Feet whose ends come when they come: a chain gives out what waits some time after its last sample.

    Some time later, once all that it has told is heard, the fusion waits for it no longer.
    """

    def __init__(self, imus, rng):
        self.navs = {name: [] for name in imus}
        self.ended, self.gone = set(), set()
        super().__init__({name: [imu] for name, imu in imus.items()}, rng)

    def ready(self):
        ends = [("end", name) for name in self.lives if not self.sources[name] and name not in self.ended]
        return super().ready() + ends + [("leave", name) for name in self.ended - self.gone if self.has_told_all(name)]

    def has_told_all(self, name):
        return not self.chains[name].waits and not any(self.topics[name, topic] for topic in ("step", "odometry"))

    def happen(self, what, name):
        if what == "end":
            self.ended.add(name)
            self.publish(name, self.chains[name].finish())
        elif what == "leave":
            self.gone.add(name)
            self.take(self.fusion.leave(name))
        else:
            super().happen(what, name)

    def publish(self, name, output):
        self.navs[name].append(output.nav)
        super().publish(name, output)


@pytest.mark.parametrize("short", FEET)
@pytest.mark.parametrize("end", [1003, 1058, 1203])
def test_the_end_of_one_foot_is_the_same_whenever_it_is_noticed(short, end):
    imus = dict(samples(walk="straight", length_m=24.0, sensor="g_sensitive"))
    imus[short] = part(imus[short], 0, end)
    offline = Together(imus)
    for seed in range(2):
        live = Ending(imus, np.random.default_rng(seed))
        found = {"body": live.run()[0]} | {foot: joined(live.navs[foot]) for foot in FEET}
        for whose, nav in found.items():
            expected = offline.body if whose == "body" else offline.nav(whose)
            for name, of_live, of_offline in zip(nav._fields, nav, expected, strict=True):
                np.testing.assert_array_equal(of_live, of_offline, err_msg=f"{whose} {name}, seed {seed}")
