"""A sled against mechanics that has a closed form."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from bobdesk.errors import InputError
from bobdesk.track.sled import GRAVITY, Sled, ride
from tests.track.made_slopes import slope

FREE = Sled(drag_area=0.0, friction=0.0, start_speed=0.0)


@pytest.mark.parametrize("step", [0.5, 1.0, 10.0])
def test_a_free_fall_keeps_its_energy(step):
    along = np.linspace(0, 1, round(600 / step) + 1)
    line = slope(600, 0.1 + 0.06 * np.sin(9 * along), step=step, radius=80)
    found = ride(line, FREE)
    fallen = line.elevations[0] - line.elevations
    np.testing.assert_allclose(found.speeds**2, 2 * GRAVITY * fallen, rtol=1e-12, atol=1e-9)
    assert not found.stops


def test_a_start_speed_is_energy_too():
    line = slope(300, 0.08)
    found = ride(line, Sled(drag_area=0.0, friction=0.0, start_speed=12.0))
    assert found.speeds[0] == 12.0
    assert found.speeds[-1] ** 2 == pytest.approx(144 + 2 * GRAVITY * 24.0, rel=1e-12)


def test_across_a_level_circle_it_is_v_squared_by_r():
    line = slope(200, 0.0, radius=25.0)
    found = ride(line, Sled(drag_area=0.0, friction=0.0, start_speed=20.0))
    np.testing.assert_allclose(found.lateral, 400 / 25.0, rtol=1e-12)
    np.testing.assert_allclose(found.load, np.hypot(16.0, GRAVITY), rtol=1e-12)


def test_on_a_falling_circle_only_the_speed_in_plan_turns():
    line = slope(100, 0.2, radius=40.0)
    found = ride(line, FREE)
    level = found.speeds**2 / (1 + 0.2**2)
    np.testing.assert_allclose(found.lateral, level / 40.0, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("start_speed", [0.0, 90.0])
def test_a_long_slope_has_its_terminal_speed(start_speed):
    sled = Sled(mass=400, drag_area=0.2, friction=0.01, start_speed=start_speed)
    line = slope(40_000, 0.1, step=5.0)
    angle = np.arctan(0.1)
    pull = GRAVITY * (np.sin(angle) - 0.01 * np.cos(angle))
    terminal = np.sqrt(2 * pull * 400 / (1.25 * 0.2))
    found = ride(line, sled)
    assert found.speeds[-1] == pytest.approx(terminal, rel=1e-6)
    assert (found.speeds <= max(terminal, start_speed) + 1e-9).all()


def test_it_comes_to_rest_where_friction_has_eaten_the_speed():
    sled = Sled(drag_area=0.0, friction=0.05, start_speed=10.0)
    found = ride(slope(500, 0.0), sled)
    assert found.stops
    assert found.stations[-1] == pytest.approx(100 / (2 * 0.05 * GRAVITY), abs=1.0)


def test_one_that_nothing_moves_stays():
    found = ride(slope(50, 0.001), Sled(start_speed=0.0, friction=0.01))
    assert found.stops
    assert found.stations.tolist() == [0.0]


def test_against_a_solver_of_differential_equations():
    length, radius = 900.0, 60.0
    sled = Sled(friction=0.008, drag_area=0.15)
    line = slope(length, 0.11, radius=radius, step=0.5)
    angle = np.arctan(0.11)
    level = np.cos(angle)

    def change(_s, u):
        load = np.hypot(u * level**2 / radius, GRAVITY * level)
        return (
            2 * GRAVITY * np.sin(angle) - 2 * sled.friction * load - sled.air_density * sled.drag_area / sled.mass * u
        )

    found = ride(line, sled)
    other = solve_ivp(change, (0, length / level), [100.0], rtol=1e-10, atol=1e-10)
    assert found.speeds[-1] ** 2 == pytest.approx(other.y[0, -1], rel=1e-5)


@pytest.mark.parametrize("name", ["mass", "friction", "drag_area", "start_speed", "air_density"])
@pytest.mark.parametrize("value", [-1.0, float("nan"), 1e9])
def test_what_no_sled_has_is_refused(name, value):
    with pytest.raises(InputError, match=name.replace("_", " ")):
        ride(slope(50, 0.1), Sled(**{name: value}))
