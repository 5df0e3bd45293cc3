"""The heading after `pdr calibrate mag`: within 1 deg all around, for every seed, as good as it says itself."""

import numpy as np

from pdr_core.intake.mag_calibration import calibration
from support.turned_magnetometer import heading_errors_rad, some_iron, turned

SEEDS = range(24)
AXES = (
    np.eye(3),
    np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]]),
    np.diag([1.0, 1.0, -1.0]),
    np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]),
)
LEVEL = ((0.0, 0.0),)


def test_the_heading_is_within_a_degree_all_around():
    worst_deg, ratios = [], []
    for seed in SEEDS:
        iron = some_iron(seed, axes=AXES[seed % 4])
        found = calibration(turned(iron, seed, noise_tesla=(0.5e-6, 1e-6)[seed % 2])[0], 48.0)
        level_rad, errors_rad = heading_errors_rad(iron, found, LEVEL), heading_errors_rad(iron, found)
        worst_deg.append(np.rad2deg(np.abs(errors_rad).max()))
        ratios.append(np.sqrt(np.mean(errors_rad**2)) / found.heading_sd_rad)
        print(
            f"seed {seed}: level foot {np.rad2deg(np.abs(level_rad).max()):.2f} deg at most, any tilt "
            f"{worst_deg[-1]:.2f}, predicted {np.rad2deg(found.heading_sd_rad):.2f} (1 sigma)"
        )
    rms = np.sqrt(np.mean(np.square(ratios)))
    print(f"{len(SEEDS)} seeds: at most {max(worst_deg):.2f} deg; rms error over prediction {rms:.2f}")
    assert max(worst_deg) < 1.0
    assert 0.4 < rms < 1.3  # the prediction is that of the worst attitude
