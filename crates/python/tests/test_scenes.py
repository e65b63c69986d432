"""Scenes run from a text."""

import numpy as np
import pytest

import piola
from piola import _native

pytestmark = pytest.mark.skipif(not hasattr(_native, "run_scene"), reason="built without the feature `scenes`")

ORBIT = """
[central]
gm = 1.0
[[body]]
name = "comet"
semi_major_axis = 1.0
eccentricity = 0.5
[time]
revolutions = 1
[reference]
closed_form = "kepler"
"""


def test_an_orbit_is_that_of_kepler():
    run = piola.run_scene(ORBIT)
    assert run.summary["status"] == "completed" and run.names == ["comet"]
    assert run.positions.shape == (len(run.t), 1, 3) == run.velocities.shape
    radii = np.linalg.norm(run.positions[:, 0], axis=1)
    assert 0.5 - 1e-9 < radii.min() and radii.max() < 1.5 + 1e-9  # a (1 - e) to a (1 + e)
    assert abs(run.t[-1] - 2.0 * np.pi) < 1e-12
    np.testing.assert_allclose(run.energy, run.energy[0], rtol=1e-12)
    assert run.coordinates is None and "completed" in repr(run)


def test_mistakes_are_a_value_error_with_their_lines():
    with pytest.raises(ValueError, match="scene:3"):
        piola.run_scene(ORBIT.replace("gm = 1.0", "gm = -1.0"))
    with pytest.raises(ValueError, match="study"):
        piola.run_scene("[wavefront]\ntype = 'point'\nlength = 1.0\n[[medium]]\ntype = 'uniform'\n")
