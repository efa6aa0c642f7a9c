"""V-g and p-k methods: exact where the damping vanishes, and honest about their accuracy."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest
import scipy.linalg

from foldwing.errors import InputError
from foldwing.stability.domains import Rectangle
from foldwing.stability.pk import pk, pk_flutter
from foldwing.stability.problem import Pencil, StillAir
from foldwing.stability.spectrum import spectrum_at_speed
from foldwing.stability.status import Status
from foldwing.stability.vg import VgResult, vg, vg_flutter
from support.typical_section import ManySections, TypicalSection

SPEEDS = np.linspace(0.2, 7.0, 35)
SIGMA = 0.4


@dataclass(frozen=True)
class Oscillator:
    """lambda^2 + 1 with forces that can be solved by hand; half chord 1.

    T = 1 - U^2 spring + U damping p + U^2 (p^2 + a p - d p^3): on p = i k this is
    1 - U^2 (spring + k^2) + i U k (damping + a U + d U k^2).
    """

    spring: float = 0.0
    damping: float = 0.0
    a: float = 0.0
    d: float = 0.0
    size: int = 1
    half_chord: float = 1.0
    highest_frequency: float = math.inf
    largest_decay: float = math.inf

    @property
    def mass(self):
        return np.eye(1)

    def pencil(self, p):
        T2 = p**2 + self.a * p - self.d * p**3 - self.spring
        T1 = (self.damping * p)[:, None, None] if self.damping else None
        return Pencil(np.eye(1, dtype=complex), T1, T2[:, None, None])

    def still_air(self):
        return StillAir(np.eye(1), np.zeros((1, 1)), np.eye(1), np.arange(1), True)


# Damping 0.02 (U + 6/U - 5) at the frequency 1: negative between U = 2 and U = 3.
HUMP = Oscillator(damping=-0.1, a=0.02, d=0.12)


def test_section_has_the_published_divergence():
    T0, _, T2 = TypicalSection().pencil(np.zeros(1, dtype=complex))
    squares = scipy.linalg.eigvals(T0, -T2[0])
    speeds = np.sqrt(squares[np.isfinite(squares) & (squares.real > 1e-9)].real)
    np.testing.assert_allclose(speeds * SIGMA, [2.828427], atol=1e-6)


def test_pk_gives_the_published_flutter_point():
    section = TypicalSection()
    (point,) = pk_flutter(section, pk(section, SPEEDS))
    assert point.event == "onset"
    assert point.speed * SIGMA == pytest.approx(2.183915, abs=1e-6)
    assert point.frequency * 2 * np.pi * SIGMA == pytest.approx(0.648984, abs=1e-6)
    assert point.accuracy < 1e-7


@pytest.mark.parametrize("damping_ratio", [0.0, 0.02])
def test_pk_flutter_is_a_neutral_root_of_the_exact_problem(damping_ratio):
    section = TypicalSection(damping_ratio=damping_ratio, half_chord=0.3)
    (point,) = pk_flutter(section, pk(section, 0.3 * SPEEDS))
    spectrum = spectrum_at_speed(section, point.speed, Rectangle((-0.5, 1), (0.01, 3)))
    neutral = spectrum.eigenvalues[np.abs(spectrum.eigenvalues.real).argmin()]
    assert spectrum.certified
    assert abs(neutral - 2j * np.pi * point.frequency) < 1e-8
    assert point.reduced_frequency == pytest.approx(neutral.imag * 0.3 / point.speed, rel=1e-7)


def test_pk_is_close_to_the_exact_roots_when_damping_is_small():
    section = TypicalSection()
    result = pk(section, np.array([0.2, 0.5, 1.0]))
    assert np.all(result.status == Status.OK)
    exact = spectrum_at_speed(section, 1.0, Rectangle((-0.5, 1), (0.01, 6))).eigenvalues
    difference = np.abs(result.eigenvalues[-1] - exact)
    assert np.all(difference < 0.05 * np.abs(exact))
    assert np.all(difference > 1e-6)


@pytest.mark.parametrize("damping_ratio", [0.0, 0.02])
@pytest.mark.parametrize("count", [40, 80, 160, 320])
def test_vg_flutter_agrees_within_its_stated_accuracy(damping_ratio, count):
    section = TypicalSection(damping_ratio=damping_ratio)
    (exact,) = pk_flutter(section, pk(section, SPEEDS))
    (point,) = vg_flutter(vg(section, np.geomspace(0.05, 3, count)))
    assert point.event == "onset"
    assert abs(point.speed - exact.speed) < point.accuracy < 0.01 * 40 / count
    assert point.frequency == pytest.approx(exact.frequency, rel=0.02 * 40 / count)


def test_vg_damping_changes_sign_at_flutter_only():
    result = vg(TypicalSection(), np.geomspace(0.15, 3, 200))
    speed, damping = result.speed * SIGMA, result.damping
    assert np.all(damping[speed < 2.18] < 0)
    assert np.all(damping[:, 0] < 0) != np.all(damping[:, 1] < 0)
    assert np.any(damping[speed > 2.19] > 0)


def test_vg_frequency_belongs_to_its_reduced_frequency():
    result = vg(TypicalSection(half_chord=0.5), np.geomspace(0.1, 2, 50))
    omega = 2 * np.pi * result.frequency
    np.testing.assert_allclose(
        omega * 0.5 / result.speed, result.reduced_frequency[:, None] + 0 * omega
    )


def test_both_methods_find_a_hump_at_its_exact_ends():
    by_pk = pk_flutter(HUMP, pk(HUMP, np.linspace(1.0, 4.0, 31)))
    by_vg = vg_flutter(vg(HUMP, np.geomspace(0.25, 1.0, 60)))
    for points in (by_pk, by_vg):
        assert [point.event for point in points] == ["onset", "recovery"]
        for point, speed in zip(points, (2.0, 3.0), strict=True):
            assert abs(point.speed - speed) < point.accuracy
            assert point.frequency == pytest.approx(1 / (2 * np.pi), rel=1e-3)
    np.testing.assert_allclose([point.speed for point in by_pk], [2, 3], rtol=1e-8)


def test_a_crossing_on_a_tabulated_airspeed_is_found_once():
    speeds = np.array([1.5, 2.0, 2.5, 3.0, 3.5])
    result = pk(HUMP, speeds)
    on_zero = replace(result, eigenvalues=result.eigenvalues.copy())
    on_zero.eigenvalues[[1, 3]] = 1j
    assert [point.speed for point in pk_flutter(HUMP, on_zero)] == pytest.approx([2.0, 3.0])


@pytest.mark.parametrize("speed_of", [lambda k: 1 / k, lambda k: 12 * k])
def test_crossings_of_a_known_curve(speed_of):
    k = np.linspace(0.5, 0.1, 40)
    speed = speed_of(k)
    curve = VgResult(k, speed[:, None], ((speed - 3) * (5 - speed))[:, None], np.ones((40, 1)))
    points = vg_flutter(curve)
    assert [point.event for point in points] == ["onset", "recovery"]
    for point, exact in zip(points, (3.0, 5.0), strict=True):
        assert abs(point.speed - exact) <= point.accuracy + 1e-12
        assert point.accuracy < 0.1
        assert speed_of(point.reduced_frequency) == pytest.approx(exact, rel=2e-3)


def test_both_methods_find_the_flutter_of_each_of_many_modes():
    sections = tuple(
        TypicalSection(e=0.1 + 0.05 * i, pitch_frequency=2.5 + 0.2 * i) for i in range(3)
    )
    each = [pk_flutter(section, pk(section, SPEEDS))[0].speed for section in sections]
    together = ManySections(sections)
    by_pk = pk_flutter(together, pk(together, SPEEDS))
    by_vg = vg_flutter(vg(together, np.geomspace(0.15, 3, 400)))
    np.testing.assert_allclose([point.speed for point in by_pk], sorted(each), rtol=1e-7)
    np.testing.assert_allclose([point.speed for point in by_vg], sorted(each), rtol=1e-3)


def test_pk_leaves_a_mode_that_stops_oscillating():
    # The stiffness 1 - U^2/4 vanishes at U = 2.
    result = pk(Oscillator(spring=0.25), np.array([0.5, 1.0, 1.5, 1.9, 2.1, 2.5]))
    assert result.status[:, 0].tolist() == [Status.OK] * 4 + [Status.LEFT_DOMAIN] * 2
    np.testing.assert_allclose(result.eigenvalues[:4, 0].imag ** 2, 1 - result.speed[:4] ** 2 / 4)
    assert np.all(np.isnan(result.eigenvalues[4:]))


def test_pk_marks_modes_that_cannot_be_told_apart():
    twins = ManySections((TypicalSection(), TypicalSection()))
    result = pk(twins, np.array([0.5, 1.0]))
    assert np.all(result.status == Status.COLLAPSED)
    assert np.all(np.isnan(result.eigenvalues))


@pytest.mark.parametrize("values", [[], [0.0, 1.0], [2.0, 1.0], [[1.0, 2.0]]])
def test_refuses_unsuitable_sequences(values):
    with pytest.raises(InputError, match="reduced_frequencies"):
        vg(TypicalSection(), np.array(values))
    with pytest.raises(InputError, match="speeds"):
        pk(TypicalSection(), np.array(values))
