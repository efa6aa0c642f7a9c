"""Unstable roots counted where the part of T that no airspeed changes depends on p.

Evidence: oscillators side by side, whose roots are those of quadratic equations.
"""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from foldwing.stability.certificate import count_unstable
from foldwing.stability.path import follow_path
from foldwing.stability.problem import Pencil
from foldwing.stability.region import Region


@dataclass(frozen=True)
class Oscillators:
    """p^2 + (c_j + d U) p + k_j - U^2 m_j = 0 for each j, in turned coordinates."""

    c: np.ndarray
    k: np.ndarray
    m: np.ndarray
    d: float = 0.0
    half_chord: float = 1.0
    highest_frequency: float = math.inf
    largest_decay: float = math.inf

    @property
    def size(self):
        return len(self.c)

    def _mixed(self, diagonals):
        turn = np.linalg.qr(np.random.default_rng(2).standard_normal((self.size, self.size)))[0]
        return np.einsum("ji,mj,jk->mik", turn, diagonals, turn).astype(complex)

    def pencil(self, p):
        return self.pencil_with_derivative(p)[0]

    def pencil_with_derivative(self, p):
        p = np.asarray(p, complex)[:, None]
        ones = np.ones_like(p * self.c)
        T0, dT0 = self._mixed(p**2 + p * self.c + self.k), self._mixed(2 * p + self.c)
        T1, dT1 = (self._mixed(self.d * z) if self.d else None for z in (p * ones, ones))
        T2 = self._mixed(-self.m * ones)
        return Pencil(T0, T1, T2), Pencil(dT0, dT1, 0 * T2)

    def unstable(self, speed):
        damping = self.c + self.d * speed
        roots = [
            np.roots([1, b, a]) for b, a in zip(damping, self.k - speed**2 * self.m, strict=True)
        ]
        return int((np.concatenate(roots).real > 0).sum())


def oscillators(count, d=0.0):
    """Some grow by themselves, some diverge, two of them hardly damped beside each other."""
    rng = np.random.default_rng(count)
    c, k, m = (
        rng.uniform(-0.2, 0.6, count),
        rng.uniform(0.1, 4.0, count),
        rng.uniform(0.0, 0.05, count),
    )
    c[:2], k[:2], m[:2] = 0.003, 1.0, 0.0
    return Oscillators(c, k, m, d)


@pytest.mark.parametrize("d", [0.0, 0.05], ids=["undamped", "with a term in U"])
@pytest.mark.parametrize("count", [1, 3, 8, 20])
def test_a_determinant_that_turns_many_times_at_the_far_end_is_counted_in_full(count, d):
    problem = oscillators(count, d)
    region = Region(threshold=0.0, lowest=0.004, highest=3.0, edge=4.0)
    path = follow_path(problem, region.point, region.parameter(), 12.0)
    speeds = np.array([0.7, 3.0, 5.0, 8.0, 12.0])
    wanted = [problem.unstable(U) for U in speeds]
    np.testing.assert_array_equal(count_unstable(problem, path, region, speeds), wanted)
    if count > 3:
        assert len(set(wanted)) > 1


def test_a_turn_is_not_taken_for_a_small_angle():
    """Twenty oscillators turn by 20 pi along the far end, of which no step may lose 2 pi."""
    problem = oscillators(20)
    region = Region(threshold=0.0, lowest=0.004, highest=3.0, edge=12.0)
    path = follow_path(problem, region.point, region.parameter(), 12.0)
    (count,) = count_unstable(problem, path, region, np.array([5.0]))
    assert count == problem.unstable(5.0)


@pytest.mark.parametrize("d", [0.0, 0.3], ids=["undamped", "with a term in U"])
def test_the_growth_of_the_unchanging_part_is_its_own_logarithmic_derivative(d):
    """Its argument turns between close points as the growth says."""
    problem = oscillators(8, d)
    region = Region(threshold=0.0, lowest=0.004, highest=3.0, edge=4.0)
    parameter = np.concatenate([t + np.array([-1e-5, 1e-5]) for t in region.parameter()[3:-1]])
    path = follow_path(problem, region.point, parameter, 12.0)
    turned = np.angle(path.constant[1::2] / path.constant[::2])
    wanted = (path.growth[::2] * np.log(path.p[1::2] / path.p[::2])).imag
    np.testing.assert_allclose(turned, wanted, rtol=1e-3, atol=1e-9)
