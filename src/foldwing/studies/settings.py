"""What a convergence study varies: the mesh, the wake, the time step, the modes, the gap."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from foldwing.aerodynamics.lattice import strips_by_segment
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import Structure, Wing
from foldwing.model.parts import MOST_MODES

MOST_PANELS, MOST_ROWS = 4000, 16000
"""Panels and rows of the wake above which a level is too costly to be tried by itself."""

HALVED = (0.25, 0.5, 1.0, 2.0, 4.0)
"""Levels of a count or length as multiples of the model's own."""

SEGMENT_MODES, SYSTEM_MODES = (6, 8, 10, 14, 20), (6, 8, 12, 16, 20)
"""Levels of the numbers of modes."""


@dataclass(frozen=True)
class Setting:
    """One thing to vary.

    Attributes
    ----------
    name : str
    own : callable
        Its value in a wing.
    changed : callable
        A wing with another value.
    levels : callable
        The values to try by default; the wing's own is always added.
    applies : callable
        Whether a model has it.
    power_law : bool
        Whether the error is expected to fall with a power of 1 / value.
    own_counts : bool
        Whether the model itself is one of the levels.
    finer_when_smaller : bool
        Whether the limit is that of small values.
    """

    name: str
    own: Callable[[Wing], float]
    changed: Callable[[Wing, float], Wing]
    levels: Callable[[Wing], Sequence[float]]
    applies: Callable[[AeroelasticWing], bool]
    power_law: bool = True
    own_counts: bool = True
    finer_when_smaller: bool = False


def _is_lattice(model: AeroelasticWing) -> bool:
    return model.aerodynamics == "lattice"


def _whole(value: float) -> int:
    return max(1, round(value))


def _strips(wing: Wing) -> float:
    return float(sum(strips_by_segment(wing)))


def _with_strips(wing: Wing, count: float) -> Wing:
    """Refine every segment alike, so that meshes are similar."""
    factor = count / _strips(wing)
    strips = tuple(_whole(factor * own) for own in strips_by_segment(wing))
    return wing.with_lattice(spanwise=strips)


def _affordable(wing: Wing, chordwise: float, strips: float, wake: float) -> bool:
    return chordwise * strips <= MOST_PANELS and chordwise * wake <= MOST_ROWS


def _chordwise_levels(wing: Wing) -> Sequence[float]:
    own = wing.lattice.chordwise
    counts = sorted({_whole(factor * own) for factor in HALVED})
    return [n for n in counts if n <= own or _affordable(wing, n, _strips(wing), _wake(wing))]


def _spanwise_levels(wing: Wing) -> Sequence[float]:
    own = _strips(wing)
    counts = [sum(strips_by_segment(_with_strips(wing, factor * own))) for factor in HALVED[1:]]
    chordwise = wing.lattice.chordwise
    return [n for n in sorted({*counts}) if n <= own or _affordable(wing, chordwise, n, 1.0)]


def _wake(wing: Wing) -> float:
    return float(wing.lattice.wake)


def _wake_levels(wing: Wing) -> Sequence[float]:
    lengths = [factor * _wake(wing) for factor in HALVED]
    chordwise = wing.lattice.chordwise
    return [length for length in lengths if _affordable(wing, chordwise, 1.0, length)]


def _with_average(wing: Wing, chordwise: float) -> Wing:
    return wing.with_lattice(scheme="average", chordwise=_integer(chordwise))


def _steps_differ(model: AeroelasticWing) -> bool:
    exact = model.wing.lattice.scheme == "exact"
    return _is_lattice(model) and exact and model.equal_chords


def _segment_modes(wing: Wing) -> float:
    return float(min(wing.analysis.bending_modes, wing.analysis.torsion_modes))


def _with_segment_modes(wing: Wing, count: float) -> Wing:
    """Scale both numbers alike, so that the models are a family; ``count`` is the smaller one."""
    least, analysis = _segment_modes(wing), wing.analysis
    bending, torsion = (
        _integer(count) if own == least else _whole(count * own / least)
        for own in (analysis.bending_modes, analysis.torsion_modes)
    )
    return wing.with_analysis(bending_modes=bending, torsion_modes=torsion)


def _segment_levels(wing: Wing) -> Sequence[float]:
    """Return counts that leave the larger number of modes within what a model may have."""
    most = max(wing.analysis.bending_modes, wing.analysis.torsion_modes)
    return [n for n in SEGMENT_MODES if n * most <= MOST_MODES * _segment_modes(wing)]


def _gap(wing: Wing) -> float:
    return max((hinge.gap for hinge in wing.hinges), default=0.0)


def _with_gap(wing: Wing, width: float) -> Wing:
    """Change all gaps by the same factor."""
    widest = _gap(wing)
    hinges = tuple(h.model_copy(update={"gap": h.gap * width / widest}) for h in wing.hinges)
    return Wing.model_validate(dict(wing) | {"hinges": hinges})


def _integer(value: float) -> float | int:
    """Return a whole number as one; another is left for the model to refuse."""
    return int(value) if float(value).is_integer() else value


SETTINGS: Mapping[str, Setting] = {
    setting.name: setting
    for setting in (
        Setting(
            "chordwise",
            lambda wing: float(wing.lattice.chordwise),
            lambda wing, value: wing.with_lattice(chordwise=_integer(value)),
            _chordwise_levels,
            _is_lattice,
        ),
        Setting("spanwise", _strips, _with_strips, _spanwise_levels, _is_lattice),
        Setting(
            "wake",
            _wake,
            lambda wing, value: wing.with_lattice(wake=value),
            _wake_levels,
            _is_lattice,
        ),
        Setting(
            "time-step",
            lambda wing: float(wing.lattice.chordwise),
            _with_average,
            lambda wing: _chordwise_levels(wing)[1:],
            _steps_differ,
            own_counts=False,
        ),
        Setting(
            "segment-modes",
            _segment_modes,
            _with_segment_modes,
            _segment_levels,
            lambda model: Structure.BEAM in model.wing.structures,
        ),
        Setting(
            "system-modes",
            lambda wing: float(wing.analysis.system_modes),
            lambda wing, value: wing.with_analysis(system_modes=_integer(value)),
            lambda wing: SYSTEM_MODES,
            lambda model: True,
            power_law=False,
        ),
        Setting(
            "gap",
            _gap,
            _with_gap,
            lambda wing: [factor * _gap(wing) for factor in (0.0, 0.25, 0.5, 1.0)],
            lambda model: _is_lattice(model) and _gap(model.wing) > 0.0,
            power_law=False,
            finer_when_smaller=True,
        ),
    )
}
"""Everything that can be varied, by name; those of the mesh first."""

MESH = ("chordwise", "spanwise", "wake")
"""Settings whose error bars make up the total."""
