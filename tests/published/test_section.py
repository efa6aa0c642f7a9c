"""Typical sections in the literature.

D. H. Hodges and G. A. Pierce, Introduction to Structural Dynamics and Aeroelasticity; I. Wang, PhD
dissertation, Duke University, 2013, Appendix B. The figures of the latter are read from speeds 0.5
apart; beside them stand values of the same theory in four digits, found independently.
"""

import numpy as np
import pytest

from foldwing.airfoil.system import SectionSystem
from foldwing.model import read_section
from foldwing.stability.flutter import find_flutter

SIGMA = 0.4
"""Plunge over torsion frequency: U/(b omega_theta) is SIGMA times U/(b omega_1)."""

PRINTED = {1.5: (4.0, 3.884), 3.7: (11.5, 11.289), 3.8: (8.5, 8.419), 7.0: (15.0, 14.858)}
"""Torsion frequency ratio -> lowest onset, as printed and in four digits."""


def test_section_of_hodges_and_pierce():
    analysis = find_flutter(SectionSystem(read_section("hodges-pierce")), (0.2, 20.0))
    assert analysis.certified
    flutter, divergence = analysis.points
    assert (flutter.kind, flutter.event) == ("flutter", "onset")
    assert SIGMA * flutter.speed == pytest.approx(2.183915, abs=1e-5)
    assert SIGMA * 2 * np.pi * flutter.frequency == pytest.approx(0.648984, abs=1e-5)
    assert divergence.kind == "divergence"
    assert SIGMA * divergence.speed == pytest.approx(2.828427, abs=1e-5)


def test_plunge_frequencies_of_the_airfoil_with_a_second_mass():
    found = SectionSystem(read_section("airfoil-3dof")).frequency_ratios[:2]
    np.testing.assert_allclose(found, (0.677, 3.519), atol=5e-4)


@pytest.mark.parametrize("torsion", PRINTED)
def test_flutter_of_the_airfoil_with_a_second_mass(torsion):
    printed, digits = PRINTED[torsion]
    section = read_section("airfoil-3dof").with_torsion(torsion)
    analysis = find_flutter(SectionSystem(section), (0.2, 30.0))
    assert analysis.certified
    assert analysis.critical.kind == "flutter"
    assert analysis.critical.speed == pytest.approx(digits, abs=1e-3)
    assert 0.0 <= printed - analysis.critical.speed < 0.5
