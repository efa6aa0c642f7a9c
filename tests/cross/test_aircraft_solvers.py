"""The flutter points of aircraft and free flaps by the methods of the industry, p-k and V-g."""

import numpy as np
import pytest

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import Hinge, read_model
from foldwing.stability.flutter import find_flutter
from foldwing.stability.newton import polish_roots
from foldwing.stability.pk import pk, pk_flutter
from foldwing.stability.vg import vg, vg_flutter

AIRCRAFT = read_model("three-segment-aircraft")
FLAP = AIRCRAFT.clamped.model_copy(
    update={"hinges": (AIRCRAFT.hinges[0], Hinge(kind="free", fold=AIRCRAFT.hinges[1].fold))}
)


def system_and_points(wing, slow, fast):
    model = AeroelasticWing(wing)
    system = model.system(model.modes())
    found = find_flutter(system, (slow, fast))
    assert found.certified
    return system, [p for p in found.points if p.kind == "flutter" and p.frequency > 1.0]


@pytest.mark.parametrize(
    ("wing", "slow", "fast"),
    [
        (AIRCRAFT.folded(30, -60), 12.0, 40.0),
        (AIRCRAFT.folded(30, 60), 13.0, 60.0),
        (FLAP, 1.0, 40.0),
    ],
    ids=["aircraft 30,-60", "aircraft 30,60", "free flap"],
)
def test_p_k_and_v_g_meet_the_flutter_points(wing, slow, fast):
    """Direction is not asked of V-g: the airspeed of its curves may run backwards along k.

    Where two modes nearly meet, above 40 m/s, p-k finds one root for both.
    """
    system, points = system_and_points(wing, slow, fast)
    assert points
    by_pk = pk_flutter(system.whole, pk(system.whole, np.linspace(slow, fast, 160)), accuracy=1e-10)
    k = np.geomspace(0.7 * min(p.p.imag for p in points), 1.3 * max(p.p.imag for p in points), 1500)
    by_vg = vg_flutter(vg(system.whole, k))
    for point in points:
        for crossings, accuracy in ((by_pk, 1e-6), (by_vg, 1e-4)):
            distance = [
                abs(c.speed / point.speed - 1) + abs(c.frequency / point.frequency - 1)
                for c in crossings
                if c.event == point.event or crossings is by_vg
            ]
            assert min(distance) < accuracy


@pytest.mark.parametrize("wing", [AIRCRAFT, FLAP], ids=["aircraft", "free flap"])
@pytest.mark.parametrize("damping", [0.0, 0.02])
def test_whole_and_divided_columns_have_the_same_roots(wing, damping):
    model = AeroelasticWing(wing.with_analysis(damping=damping))
    system = model.system(model.modes())
    U = np.full(2, 20.0)
    elastic = system.omega[system.omega > 0.0]
    guess = 1j * elastic[1:3] * system.half_chord / U
    divided = polish_roots(system, guess, U)
    whole = polish_roots(system.whole, divided.p * (1 + 1e-5), U)
    assert divided.converged.all()
    assert whole.converged.all()
    np.testing.assert_allclose(whole.p, divided.p, rtol=1e-9)
    shapes = [
        problem.modal_vectors(roots.p, U, roots.right)
        for problem, roots in ((system, divided), (system.whole, whole))
    ]
    likeness = np.abs(np.einsum("mi,mi->m", shapes[0].conj(), shapes[1]))
    np.testing.assert_allclose(likeness, 1.0, rtol=1e-9)
