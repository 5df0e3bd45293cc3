"""What robot_localization, Nav2 and RViz take as it is: the topics of two people's nodes, one of them turning."""

from collections import Counter

import numpy as np
import pytest
from numpy.lib.stride_tricks import sliding_window_view
from scipy.spatial.transform import Rotation

from pdr_core.records import joined
from pdr_nodes.convert import nav_block
from pdr_nodes.covariance import LARGEST_POSE, LARGEST_TWIST
from support.feet import FEET
from support.people import WALKS, People, offline
from support.walks import stamps

STRIDE = 110  # samples at 100 Hz
TOLERANCE = 1e-9
PERSONS = [f"/{person}" for person in WALKS]
SPEAKERS = [f"/{person}{foot}" for person in WALKS for foot in ("", *(f"/{foot}" for foot in FEET))]
pytestmark = pytest.mark.usefixtures("ros_environment")


@pytest.fixture(scope="module")
def expected():
    """What is made of each walk without nodes."""
    return {person: offline(person) for person in WALKS}


@pytest.fixture(scope="module")
def people(expected, tmp_path_factory):
    return People(tmp_path_factory.mktemp("people"), expected)


def nav_of(people, address):
    return joined([nav_block(message) for message in people.odometry[address]])


@pytest.mark.parametrize("address", SPEAKERS)
def test_nobody_is_taken_for_somebody_else(people, expected, address):
    """Each is where she is offline, from her own samples alone."""
    _, person, *foot = address.split("/")
    alone, live = expected[person]["".join(f"/{part}" for part in foot)], nav_of(people, address)
    np.testing.assert_array_equal(live.stamp_ns, alone.stamp_ns)
    for name, of_nodes, of_core in zip(live._fields, live, alone, strict=True):
        np.testing.assert_allclose(of_nodes, of_core, rtol=0.0, atol=TOLERANCE, err_msg=name)


@pytest.mark.parametrize("person", WALKS)
def test_frames_are_those_of_rep_105_with_the_prefix_of_the_person(people, person):
    body = {(m.header.frame_id, m.child_frame_id) for m in people.odometry[f"/{person}"]}
    assert body == {(f"{person}/odom", f"{person}/base_footprint")}
    for foot in FEET:
        said = {(m.header.frame_id, m.child_frame_id) for m in people.odometry[f"/{person}/{foot}"]}
        assert said == {(f"{person}/odom", f"{person}/{foot}_foot")}
    path = people.paths[person][-1]
    assert {path.header.frame_id, *(place.header.frame_id for place in path.poses)} == {f"{person}/odom"}
    assert len(path.poses) > 5


@pytest.mark.parametrize(("address", "aside"), [("/alice", 0.15), ("/bob", 0.06)])
def test_who_walks_forward_at_any_yaw_has_a_twist_along_x(people, address, aside):
    """Over every stride; within one the middle of two feet sways, and in a turn a standing foot still points back."""
    nav = nav_of(people, address)
    ahead, left, _ = sliding_window_view(nav.velocity_mps, STRIDE, axis=0).mean(axis=2).T
    walking = ahead > 0.5
    assert walking.sum() > 3 * STRIDE
    assert np.abs(left[walking] / ahead[walking]).max() < aside
    assert nav.velocity_mps[:, 0].min() > -0.01  # nobody walks back
    yaw = np.unwrap(2.0 * np.arctan2(nav.quat_xyzw[:, 2], nav.quat_xyzw[:, 3]))
    assert {"/alice": np.ptp(yaw) > 6.0, "/bob": np.abs(yaw - 2.0).max() < 0.2}[address]


@pytest.mark.parametrize("address", SPEAKERS)
def test_the_twist_is_in_the_child_frame(people, address):
    """Turned by the orientation it is how the pose moves; the height of a person is that of the foot that stands."""
    nav = nav_of(people, address)
    turned = Rotation.from_quat(nav.quat_xyzw[1:-1]).apply(nav.velocity_mps[1:-1])
    moved = (nav.position_m[2:] - nav.position_m[:-2]) / 0.02
    axes, fast = slice(2 if address in PERSONS else 3), np.linalg.norm(turned, axis=1) > 1.0
    assert fast.sum() > 100
    assert np.median(np.linalg.norm((turned - moved)[:, axes], axis=1)[fast]) < 0.02


@pytest.mark.parametrize("address", SPEAKERS)
@pytest.mark.parametrize("which", ["pose_covariance", "twist_covariance"])
def test_covariances_are_symmetric_positive_and_bounded(people, address, which):
    covariance = getattr(nav_of(people, address), which)
    np.testing.assert_allclose(covariance, covariance.transpose(0, 2, 1), rtol=0.0, atol=1e-15)
    assert np.linalg.eigvalsh(covariance).min() > 1e-9
    variances = np.diagonal(covariance, axis1=1, axis2=2)
    assert (variances <= (LARGEST_POSE if which == "pose_covariance" else LARGEST_TWIST)).all()
    assert (variances[:, :3] < 1.0).all()  # of a walk of 6 m at 1.4 m/s


@pytest.mark.parametrize("address", SPEAKERS)
def test_a_place_is_known_less_and_less(people, address):
    variance = np.diagonal(nav_of(people, address).pose_covariance[:, :2, :2], axis1=1, axis2=2).sum(axis=1)
    assert variance[-1] > 2.0 * variance[0]


@pytest.mark.parametrize("address", SPEAKERS)
def test_quaternions_are_unit_and_a_person_is_level(people, address):
    nav = nav_of(people, address)
    np.testing.assert_allclose(np.linalg.norm(nav.quat_xyzw, axis=1), 1.0, rtol=0.0, atol=1e-12)
    if address in PERSONS:
        assert (nav.quat_xyzw[:, :2] == 0.0).all()


def test_each_frame_has_one_parent_and_one_broadcaster(people):
    parents = {(t.child_frame_id, t.header.frame_id) for t in people.single}
    assert parents == {(f"{person}/base_footprint", f"{person}/odom") for person in WALKS}
    assert people.broadcasters == len(WALKS)
    assert set(people.publishers.values()) == {1}
    told = Counter((t.child_frame_id, *stamps([t])) for t in people.single)
    assert max(told.values()) == 1


@pytest.mark.parametrize("person", WALKS)
def test_the_transform_is_the_odometry(people, person):
    """Of the same stamp: a walk that is played faster than it was walked overflows the short queue of /tf."""
    odometry = dict(zip(stamps(people.odometry[f"/{person}"]), people.odometry[f"/{person}"], strict=True))
    mine = [t for t in people.single if t.child_frame_id.startswith(f"{person}/")]
    assert len(mine) > 300
    for stamp_ns, transform in zip(stamps(mine), mine, strict=True):
        pose = odometry[stamp_ns].pose.pose
        assert transform.transform.rotation == pose.orientation
        assert transform.transform.translation.x == pose.position.x
        assert transform.transform.translation.y == pose.position.y
