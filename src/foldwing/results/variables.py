"""Every variable and coordinate that a dataset may hold: name, dimensions, unit, meaning."""

from collections.abc import Mapping
from dataclasses import dataclass

Dims = tuple[str, ...]


@dataclass(frozen=True)
class Variable:
    """One row of the schema.

    Attributes
    ----------
    name : str
    dims : tuple of tuple of str
        The dimensions it may have; more than one choice when kinds of dataset differ.
    units : str
        ``1`` for dimensionless numbers, empty for text.
    long_name : str
    dtype : str
        ``real``, ``complex``, ``integer``, ``truth``, ``text`` or ``status``.
    """

    name: str
    dims: tuple[Dims, ...]
    units: str
    long_name: str
    dtype: str = "real"


FOLD: Dims = ("fold",)
_MODE: Dims = ("fold", "mode")
_LOCUS: Dims = ("fold", "speed", "mode")
_TABLE: Dims = ("flutter_point",)
_CURVE: Dims = ("curve_sample",)
_MEASURED: Dims = ("measured",)
_PANEL: Dims = ("panel",)
_LEVEL: Dims = ("level",)
_AT_LEVEL: Dims = ("level", "flutter_point")
_CONVERGENCE: Dims = ("setting", "flutter_point")
_STRIP: Dims = ("strip",)
_TIME: Dims = ("time", "mode")
_STEADY_CASE: Dims = ("fold", "gap")
_SEGMENT: Dims = (*_STEADY_CASE, "wing_segment")


def variable(name: str, dims: Dims, units: str, long_name: str, dtype: str = "real") -> Variable:
    """Return a variable that always has the same dimensions."""
    return Variable(name, (dims,), units, long_name, dtype)


_COORDINATES = (
    variable("fold", FOLD, "1", "case index", "integer"),
    variable("speed", ("speed",), "m/s", "airspeed"),
    variable("mode", ("mode",), "1", "mode or branch, from 1", "integer"),
    variable("point", ("point",), "1", "point index", "integer"),
    variable("segment", ("point",), "1", "segment, 1 at the root", "integer"),
    variable("chordwise", ("point",), "1", "index along the chord within the segment", "integer"),
    variable("spanwise", ("point",), "1", "index along the span within the segment", "integer"),
    variable("axis", ("axis",), "", "global axis: x aft, y outboard, z up", "text"),
    variable("flutter_point", _TABLE, "1", "row of the table of flutter points", "integer"),
    variable("contour_growth", ("contour_growth",), "1/s", "growth rate of the contour grid"),
    variable("contour_frequency", ("contour_frequency",), "Hz", "frequency of the contour grid"),
    variable("curve_sample", _CURVE, "1", "sample of the continuation curves", "integer"),
    variable("measured", _MEASURED, "1", "measured point", "integer"),
    variable("wing_segment", ("wing_segment",), "1", "segment, 1 at the root", "integer"),
    variable(
        "moving_mode", ("moving_mode",), "1", "natural mode that the work is done on", "integer"
    ),
    variable(
        "driving_mode", ("driving_mode",), "1", "natural mode that causes the force", "integer"
    ),
    variable("leading_mode", ("leading_mode",), "1", "natural mode with a large share", "integer"),
    variable("panel", _PANEL, "1", "panel of the lattice", "integer"),
    variable("panel_segment", _PANEL, "1", "segment of the panel, 1 at the root", "integer"),
    variable("panel_chordwise", _PANEL, "1", "row of the panel, 0 at the leading edge", "integer"),
    variable("panel_spanwise", _PANEL, "1", "strip of the panel, 0 at the root", "integer"),
    variable("panel_span", _PANEL, "m", "way along the folded wing from the root"),
    variable("corner", ("corner",), "1", "corner of the panel, around it", "integer"),
    variable("setting", ("setting",), "", "setting of the computation that is varied", "text"),
    variable("level", _LEVEL, "1", "computation with one setting changed", "integer"),
    variable("gap", ("gap",), "", "gaps between segments: open as in the model, or closed", "text"),
    variable("hinge", ("hinge",), "1", "hinge, 2 between segments 1 and 2", "integer"),
    variable("strip", _STRIP, "1", "strip of a lattice", "integer"),
    variable("strip_gap", _STRIP, "", "gaps of the lattice that the strip belongs to", "text"),
    variable("strip_segment", _STRIP, "1", "segment that the strip belongs to", "integer"),
    variable("strip_inner", _STRIP, "m", "inboard edge of the strip along the unfolded span"),
    variable("strip_outer", _STRIP, "m", "outboard edge of the strip along the unfolded span"),
    variable("strip_chord", _STRIP, "m", "chord of the strip"),
    variable("row", ("row",), "1", "panel along the chord, 1 at the leading edge", "integer"),
    variable("edge", ("edge",), "", "edge of a strip: inner or outer", "text"),
    variable("time", ("time",), "s", "time after the disturbance"),
    variable("body", ("body",), "", "wing, fuselage, tail, or the aircraft as a whole", "text"),
    variable("surface", ("surface",), "", "segment from the root, or the tail", "text"),
    variable("clamped_mode", ("clamped_mode",), "1", "branch of the clamped wing", "integer"),
    variable("clamped_point", ("clamped_point",), "1", "flutter point of it", "integer"),
    variable("flight_model", ("flight_model",), "", "model of the rigid aircraft", "text"),
    variable(
        "flight_root", ("flight_root",), "1", "eigenvalue of a model, phugoid first", "integer"
    ),
    variable("state", ("state",), "", "state: u, w, q or theta", "text"),
    variable("equation", ("equation",), "", "state whose rate a row of the matrix gives", "text"),
    variable("flight_motion", ("flight_motion",), "1", "motion of the four states", "integer"),
    variable("path_sample", ("path_sample",), "1", "sample of a flight path", "integer"),
    variable("torsion_frequency_ratio", FOLD, "1", "frequency of pitch over that of plunge"),
    variable("change", ("change",), "1", "change of the lowest onset, by torsion", "integer"),
    variable("side", ("side",), "", "below or above the torsion frequency of a change", "text"),
    variable("crossing", ("crossing",), "1", "plunge mode whose frequency pitch meets", "integer"),
)

_MODES = (
    variable("natural_frequency", _MODE, "Hz", "natural frequency"),
    variable("mode_name", _MODE, "", "name of the mode", "text"),
    variable("mode_confidence", _MODE, "1", "likeness (MAC) to the same mode at the previous fold"),
    variable("bending_share", _MODE, "1", "share of bending in the energy of the mode"),
    variable("position", ("fold", "point", "axis"), "m", "position on the folded wing at rest"),
    variable("mode_shape", ("fold", "mode", "point", "axis"), "m", "displacement in the mode"),
    variable("mass_centre", ("fold", "body", "axis"), "m", "centre of mass at rest"),
    variable(
        "mass_centre_shape", ("fold", "mode", "body", "axis"), "m", "its displacement in the mode"
    ),
    Variable("status", (FOLD, _LOCUS), "1", "how the computation ended", "status"),
)

_LOCI = (
    variable("eigenvalue", _LOCUS, "rad/s", "eigenvalue", "complex"),
    variable("frequency", _LOCUS, "Hz", "frequency of the eigenvalue"),
    variable("damping", _LOCUS, "1", "damping ratio -Re/|Im|, positive when stable"),
    variable("growth", _LOCUS, "1/s", "growth rate, the real part of the eigenvalue"),
    variable("residual", _LOCUS, "1", "residual of the eigenvalue"),
    variable(
        "confidence", _LOCUS, "1", "likeness (MAC) to the same branch at the previous airspeed"
    ),
    variable("branch_name", ("mode",), "", "name of the branch", "text"),
    variable(
        "branch_motion", ("mode",), "", "elastic, real, neutral or a motion as a whole", "text"
    ),
    variable(
        "loci_certified", ("fold", "speed"), "", "all unstable eigenvalues are listed", "truth"
    ),
)

_CASES = (
    variable(
        "certified", FOLD, "", "all unstable eigenvalues were found at every airspeed", "truth"
    ),
    variable("case_status", FOLD, "1", "how the computation of the case ended", "status"),
    variable("valid_from", FOLD, "m/s", "lowest airspeed for which the result holds"),
    variable("uncertified_modes", FOLD, "", "modes not resolved at the lowest airspeeds", "text"),
    variable("unstable_from_start", FOLD, "1", "unstable roots at the lowest airspeed", "integer"),
    variable(
        "unstable_motions", FOLD, "", "motions of the aircraft unstable from the start", "text"
    ),
    variable("message", FOLD, "", "why the case failed or is doubtful", "text"),
)

_POINTS = (
    variable("case", _TABLE, "1", "index of the case along fold", "integer"),
    variable("kind", _TABLE, "", "flutter or divergence", "text"),
    variable("event", _TABLE, "", "onset, recovery or merger", "text"),
    variable("class", _TABLE, "", "hump or coalescence", "text"),
    variable("flutter_speed", _TABLE, "m/s", "airspeed of the flutter point"),
    variable("flutter_frequency", _TABLE, "Hz", "frequency of the flutter point"),
    variable("strength", _TABLE, "s/m", "strength of the instability, d(Re/Im)/dU"),
    variable("branch", _TABLE, "1", "branch, -1 when not known", "integer"),
    variable("flutter_mode_name", _TABLE, "", "still-air mode that the root starts from", "text"),
    variable("flutter_mode_confidence", _TABLE, "1", "confidence in the name of the mode"),
    variable("threshold", _TABLE, "1", "damping ratio at which the point is reported"),
    variable("point_residual", _TABLE, "1", "residual of the flutter point"),
    variable("motion", _TABLE, "", "elastic, phugoid, short period, body freedom", "text"),
    variable("flutter_shape", (*_TABLE, "point", "axis"), "m", "motion at the point", "complex"),
)

_EXTRAS = (
    variable(
        "determinant",
        ("contour_growth", "contour_frequency"),
        "1",
        "determinant of the flutter equation",
        "complex",
    ),
    variable("curve_id", _CURVE, "1", "number of the curve", "integer"),
    variable("curve_fold", _CURVE, "degree", "fold angle along the curve"),
    variable("curve_speed", _CURVE, "m/s", "airspeed along the curve"),
    variable("curve_frequency", _CURVE, "Hz", "frequency along the curve"),
    variable("curve_strength", _CURVE, "s/m", "strength along the curve"),
    variable("curve_kind", _CURVE, "", "flutter or divergence", "text"),
    variable("measured_fold", _MEASURED, "degree", "measured: fold angle"),
    variable("measured_speed", _MEASURED, "m/s", "measured: airspeed of flutter"),
    variable("measured_frequency", _MEASURED, "Hz", "measured: frequency"),
    variable("response", _TIME, "1", "modal displacement over the largest of all modes"),
    variable("response_envelope", _TIME, "1", "amplitude of the identified motion"),
)

_PAIRS: Dims = (*_TABLE, "moving_mode", "driving_mode")

_LOADS = (
    variable("work", (*_TABLE, "wing_segment"), "J", "work of the air on the segment over a cycle"),
    variable(
        "work_between_modes", _PAIRS, "J", "work of the air on a mode by the force of another"
    ),
    variable("kinetic_energy", _TABLE, "J", "kinetic energy at full amplitude of the motion"),
    variable(
        "mode_share", (*_TABLE, "moving_mode"), "1", "share of the mode in the kinetic energy"
    ),
    variable("panel_position", (*_PANEL, "corner", "axis"), "m", "corners of the panels at rest"),
    variable("circulation", (*_TABLE, *_PANEL), "m^2/s", "circulation, positive lifts", "complex"),
    variable(
        "pressure", (*_TABLE, *_PANEL), "Pa", "pressure below less above the panel", "complex"
    ),
    variable(
        "mode_pressure", ("leading_mode", *_PANEL), "Pa", "what the mode adds to it", "complex"
    ),
)

_LEVELS = (
    variable("level_setting", _LEVEL, "", "setting that is changed", "text"),
    variable("level_value", _LEVEL, "1", "its value: a number, chords of wake, or a gap in m"),
    variable("level_own", _LEVEL, "", "the model's own settings", "truth"),
    variable("level_status", _LEVEL, "1", "how the computation ended", "status"),
    variable("level_message", _LEVEL, "", "why the computation failed or is doubtful", "text"),
    variable("level_speed", _AT_LEVEL, "m/s", "airspeed of the same flutter point"),
    variable("level_frequency", _AT_LEVEL, "Hz", "frequency of the same flutter point"),
    variable("level_likeness", _AT_LEVEL, "1", "likeness (MAC) of its motion to the model's own"),
    variable("convergence", _CONVERGENCE, "", "how the airspeed converges", "text"),
    variable("order", _CONVERGENCE, "1", "observed order of convergence"),
    variable("limit_speed", _CONVERGENCE, "m/s", "extrapolated airspeed"),
    variable("error_speed", _CONVERGENCE, "m/s", "error bar of the airspeed"),
    variable("mesh_limit_speed", _TABLE, "m/s", "airspeed extrapolated in chord, span and wake"),
    variable("mesh_error_speed", _TABLE, "m/s", "error bar of chord, span and wake together"),
)

_STEADY = (
    variable(
        "lift_slope", _STEADY_CASE, "1/rad", "slope of the lift coefficient, on the developed area"
    ),
    variable("projected_lift_slope", _STEADY_CASE, "1/rad", "the same on the area seen from above"),
    variable("projected_area", FOLD, "m^2", "area of the segments seen from above"),
    variable("lift_coefficient", _STEADY_CASE, "1", "lift coefficient on the developed area"),
    variable("lift", _STEADY_CASE, "N", "force up"),
    variable("side_force", _STEADY_CASE, "N", "force outboard, along y"),
    variable("induced_drag", _STEADY_CASE, "N", "induced drag in the Trefftz plane"),
    variable("least_drag", _STEADY_CASE, "N", "least induced drag of this shape for this lift"),
    variable("efficiency", _STEADY_CASE, "1", "least over actual induced drag"),
    variable("pitching_moment", _STEADY_CASE, "N m", "about the elastic axis at the root, nose up"),
    variable("root_moment", _STEADY_CASE, "N m", "about the root along the stream, bending up"),
    variable(
        "aerodynamic_centre", _STEADY_CASE, "1", "fraction of the root chord from its leading edge"
    ),
    variable("hinge_moment", (*_STEADY_CASE, "hinge"), "N m", "of all loads outboard, folding up"),
    variable("segment_normal_force", _SEGMENT, "N", "force along the normal of the segment"),
    variable("segment_lift", _SEGMENT, "N", "force up on the segment"),
    variable("segment_side_force", _SEGMENT, "N", "force outboard on the segment, along y"),
    variable("segment_pitching_moment", _SEGMENT, "N m", "about its elastic axis, nose up"),
    variable(
        "segment_bending_moment", _SEGMENT, "N m", "of its own load about its inboard edge, up"
    ),
    variable("segment_centre_x", _SEGMENT, "1", "centre of pressure, fraction of the chord"),
    variable("segment_centre_y", _SEGMENT, "1", "centre of pressure, fraction of the span"),
    variable("strip_circulation", ("fold", "strip"), "m^2/s", "circulation of the strip"),
    variable("local_lift_coefficient", ("fold", "strip"), "1", "coefficient of the normal force"),
    variable("panel_circulation", ("fold", "strip", "row"), "m^2/s", "circulation of the panel"),
    variable(
        "strip_edge", ("fold", "strip", "edge", "axis"), "m", "leading edge on the folded wing"
    ),
)

_SURFACE: Dims = ("fold", "surface")
_CLAMPED: Dims = ("clamped_point",)

_AIRCRAFT = (
    variable("surface_lift", _SURFACE, "N", "vertical lift of the surface of the half aircraft"),
    variable("lift_share", _SURFACE, "1", "share of the surface in the weight"),
    variable("slowest_speed", FOLD, "m/s", "airspeed below which level flight is out of reach"),
    variable("trim_angle", ("fold", "speed"), "degree", "angle of attack of the wing"),
    variable("trim_tail_angle", ("fold", "speed"), "degree", "angle of attack of the tail"),
    variable("surface_lift_coefficient", ("fold", "speed", "surface"), "1", "of its normal force"),
    variable(
        "clamped_eigenvalue",
        ("speed", "clamped_mode"),
        "rad/s",
        "eigenvalue with the root clamped",
        "complex",
    ),
    variable("clamped_branch_name", ("clamped_mode",), "", "name of its branch", "text"),
    variable("clamped_kind", _CLAMPED, "", "root clamped: flutter or divergence", "text"),
    variable("clamped_event", _CLAMPED, "", "root clamped: onset, recovery or merger", "text"),
    variable("clamped_class", _CLAMPED, "", "root clamped: hump or coalescence", "text"),
    variable("clamped_flutter_speed", _CLAMPED, "m/s", "root clamped: airspeed of the point"),
    variable("clamped_flutter_frequency", _CLAMPED, "Hz", "root clamped: frequency of the point"),
    variable("clamped_flutter_mode", _CLAMPED, "", "root clamped: mode of the point", "text"),
)

_FLIGHT_ROOT: Dims = ("flight_model", "flight_root")
_SWEPT: Dims = ("flight_model", "speed")
_MOTION: Dims = ("flight_motion",)
_PATH: Dims = (*_MOTION, "path_sample")

_FLIGHT = (
    variable("flight_eigenvalue", _FLIGHT_ROOT, "rad/s", "eigenvalue", "complex"),
    variable("flight_mode", _FLIGHT_ROOT, "", "mode of the eigenvalue", "text"),
    variable("flight_period", _FLIGHT_ROOT, "s", "period of an oscillation"),
    variable("flight_damping_ratio", _FLIGHT_ROOT, "1", "damping ratio -Re/|eigenvalue|"),
    variable("flight_time_to_half", _FLIGHT_ROOT, "s", "time in which the amplitude halves"),
    variable("flight_time_to_double", _FLIGHT_ROOT, "s", "time in which the amplitude doubles"),
    variable("flight_cycles", _FLIGHT_ROOT, "1", "cycles in which it halves or doubles"),
    variable("swept_eigenvalue", (*_SWEPT, "flight_root"), "rad/s", "eigenvalue", "complex"),
    variable("swept_mode", (*_SWEPT, "flight_root"), "", "mode of the eigenvalue", "text"),
    variable("phugoid_product", _SWEPT, "m/s^2", "angular frequency of the phugoid times airspeed"),
    variable("swept_lift_coefficient", ("speed",), "1", "lift coefficient of level flight"),
    variable("state_matrix", ("equation", "state"), "SI", "matrix of the four states"),
    variable("X_u", (), "N s/m", "force along x per velocity along x"),
    variable("X_w", (), "N s/m", "force along x per velocity along z"),
    variable("Z_u", (), "N s/m", "force along z per velocity along x"),
    variable("Z_w", (), "N s/m", "force along z per velocity along z"),
    variable("Z_q", (), "N s", "force along z per pitch rate"),
    variable("M_u", (), "N s", "pitching moment per velocity along x"),
    variable("M_w", (), "N s", "pitching moment per velocity along z"),
    variable("M_q", (), "N m s", "pitching moment per pitch rate"),
    variable("trim_lift_coefficient", (), "1", "lift coefficient on the area of the wing"),
    variable("trim_drag_coefficient", (), "1", "drag coefficient on the area of the wing"),
    variable("wing_lift_coefficient", (), "1", "lift coefficient of the wing"),
    variable("tail_lift_coefficient", (), "1", "lift coefficient of the tail on its own area"),
    variable("static_margin", (), "1", "centre of gravity ahead of the neutral point, in chords"),
    variable("neutral_point", (), "m", "neutral point aft of the wing's quarter chord"),
    variable("motion_mode", _MOTION, "", "mode of the motion", "text"),
    variable("motion_eigenvalue", _MOTION, "rad/s", "eigenvalue of the motion", "complex"),
    variable("motion_shape", (*_MOTION, "state"), "SI", "states in the motion", "complex"),
    variable("path_time", _PATH, "s", "time along the flight path"),
    variable("path_distance", _PATH, "m", "distance flown over the ground"),
    variable("path_ahead", _PATH, "m", "distance ahead of the steadily flying point"),
    variable("path_altitude", _PATH, "m", "height above the steadily flying point"),
    variable("path_pitch", _PATH, "degree", "change of the pitch angle, nose up"),
)

_CHANGE: Dims = ("change",)
_AT_CHANGE: Dims = ("change", "side")

_SECTION = (
    variable("speed_ratio", _TABLE, "1", "airspeed over half chord and plunge frequency"),
    variable("frequency_ratio", _TABLE, "1", "frequency over that of plunge"),
    variable("curve_torsion_ratio", _CURVE, "1", "torsion frequency ratio along the curve"),
    variable("change_torsion_ratio", _CHANGE, "1", "where the lowest onset changes its curve"),
    variable("change_kind", _CHANGE, "", "jump or crossing", "text"),
    variable("change_speed", _AT_CHANGE, "m/s", "lowest onset on both sides"),
    variable("change_frequency", _AT_CHANGE, "Hz", "its frequency on both sides"),
    variable("change_confirmed", _CHANGE, "", "found again by searches on both sides", "truth"),
    variable(
        "crossing_torsion_ratio", ("crossing",), "1", "where pitch and plunge alone are in tune"
    ),
)

VARIABLES: Mapping[str, Variable] = {
    row.name: row
    for row in (
        *_MODES,
        *_LOCI,
        *_CASES,
        *_POINTS,
        *_EXTRAS,
        *_LOADS,
        *_LEVELS,
        *_STEADY,
        *_AIRCRAFT,
        *_FLIGHT,
        *_SECTION,
    )
}
"""Every variable a dataset may hold."""

COORDINATES: Mapping[str, Variable] = {row.name: row for row in _COORDINATES}
"""Every coordinate a dataset may hold, besides the fold angles ``fold_2``, ``fold_3``, ..."""
