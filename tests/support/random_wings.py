"""Random wings for property tests: any number of segments, folds, dampings and mass ratios."""

import numpy as np

from foldwing.model import Air, Analysis, Hinge, Segment, Wing


def random_wing(rng: np.random.Generator) -> Wing:
    """Return a wing whose numbers are drawn over the range of real drones and aircraft."""
    count = int(rng.integers(1, 4))
    chord = float(rng.uniform(0.05, 1.5))
    aspect = float(rng.uniform(4.0, 12.0))
    shares = rng.uniform(0.5, 1.5, count)
    spans = aspect * chord * shares / shares.sum()
    density = 1.2
    ratio = float(np.exp(rng.uniform(np.log(3.0), np.log(60.0))))
    mass = ratio * np.pi * density * (chord / 2) ** 2
    slenderness = float(np.exp(rng.uniform(np.log(1.0), np.log(30.0))))
    omega_torsion = float(rng.uniform(20.0, 120.0))
    elastic_axis = float(rng.uniform(0.25, 0.55))
    mass_centre = float(np.clip(elastic_axis + rng.uniform(-0.08, 0.15), 0.2, 0.65))
    x_cg = (mass_centre - elastic_axis) * chord
    inertia = mass * (chord**2 * float(rng.uniform(0.05, 0.1)) + x_cg**2)
    span = float(spans.sum())
    torsion = inertia * (omega_torsion * 2 * span / np.pi) ** 2
    bending = mass * (omega_torsion / slenderness) ** 2 * span**4 / 12.36
    segments = tuple(
        Segment(
            span=float(length),
            chord=chord * float(rng.uniform(0.8, 1.2) if rng.random() < 0.3 else 1.0),
            bending_stiffness=bending,
            torsion_stiffness=torsion,
            mass_per_span=mass,
            inertia_per_span=inertia * 1.5,
            elastic_axis=elastic_axis,
            mass_centre=mass_centre,
        )
        for length in spans
    )
    return Wing(
        segments=segments,
        hinges=tuple(_random_hinge(rng, bending / span) for _ in range(count - 1)),
        air=Air(density=density),
        analysis=Analysis(
            bending_modes=6,
            torsion_modes=6,
            system_modes=int(rng.integers(6, 13)),
            damping=float(rng.choice([0.0, 0.005, 0.02])),
        ),
    )


def _random_hinge(rng: np.random.Generator, stiffness: float) -> Hinge:
    fold = float(rng.uniform(-150.0, 150.0))
    if rng.random() < 0.3:
        return Hinge(kind="rigid", fold=fold)
    return Hinge(stiffness=stiffness * float(np.exp(rng.uniform(-2.0, 3.0))), fold=fold)
