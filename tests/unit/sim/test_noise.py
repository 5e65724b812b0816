"""The error model: size, correlation and reproducibility."""

import math
import statistics

import pytest

from crew.sim.noise import ATTITUDE_SIGMA_RAD, POSE_SIGMA_M, GaussMarkov, stream
from crew.sim.vehicle.estimator import DroneEstimator, RoverEstimator
from crew.sim.vehicle.state import State


def test_gauss_markov_has_its_sigma_and_time_constant() -> None:
    process = GaussMarkov(stream(3, "test"), sigma=0.15, tau_s=4.0, step_s=0.5)
    values = [process.step() for _ in range(40_000)]
    assert statistics.fmean(values) == pytest.approx(0.0, abs=0.015)
    assert statistics.pstdev(values) == pytest.approx(0.15, rel=0.05)
    lagged = statistics.fmean(a * b for a, b in zip(values, values[8:], strict=False)) / 0.15**2  # 4 s apart
    assert lagged == pytest.approx(math.exp(-1.0), abs=0.06)


def test_streams_differ_by_name_and_seed_and_repeat() -> None:
    def first(seed: int, name: str) -> float:
        return stream(seed, name).random()

    assert first(1, "a") == first(1, "a")
    assert len({first(1, "a"), first(1, "b"), first(2, "a")}) == 3


def test_drone_errors_have_the_fixed_sigmas() -> None:
    xs, rolls = [], []
    for seed in range(400):  # independent runs: one sample of each
        estimator = DroneEstimator(seed, "iris", 0.004, 0.02)
        estimator.update_position(State())
        estimator.update_attitude(State())
        xs.append(estimator.state.x)
        rolls.append(estimator.state.roll)
    assert statistics.pstdev(xs) == pytest.approx(POSE_SIGMA_M, rel=0.12)
    assert statistics.pstdev(rolls) == pytest.approx(ATTITUDE_SIGMA_RAD, rel=0.12)


def test_rover_drifts_by_about_a_percent_without_its_reference() -> None:
    errors = []
    for seed in range(200):
        estimator, true = RoverEstimator(seed, "tb3", 0.02), State()
        for step in range(50):  # a metre within the first second, before the second fix
            estimator.update(true)
            if step == 0:
                start = estimator.state.x
            true.x += 0.02
        errors.append(estimator.state.x - start - (true.x - 0.02))
    assert statistics.pstdev(errors) == pytest.approx(0.01, rel=0.2)


def test_rover_reference_bounds_the_error() -> None:
    estimator, true = RoverEstimator(5, "tb3", 0.02), State()
    errors = []
    for _ in range(50 * 300):
        true.x += 0.6 * 0.02
        estimator.update(true)
        errors.append(math.hypot(estimator.state.x - true.x, estimator.state.y - true.y))
    assert max(errors) < 0.25
    assert statistics.fmean(errors) < 0.08


def test_without_noise_the_estimate_is_the_truth() -> None:
    true = State()
    true.x, true.y, true.z, true.yaw = 1.0, 2.0, 3.0, 0.5
    drone, rover = DroneEstimator(0, "d", 0.004, 0.02, noise=False), RoverEstimator(0, "r", 0.02, noise=False)
    drone.update_position(true)
    drone.update_attitude(true)
    rover.update(true)
    for s in (drone.state, rover.state):
        assert (s.x, s.y, s.z, s.yaw) == (1.0, 2.0, 3.0, 0.5)
