"""Pictures of results: a dataset goes in, figures come out; nothing is computed here.

A picture is described once (`picture`) and drawn by two renderers.

==========================  ===================================================================
`frequencies`               natural frequencies against the fold angle, or as bars
`loci`                      growth and frequency against airspeed; the root locus
`boundary`                  flutter speed, frequency and strength against the fold angle
`clamped`                   an aircraft beside its wing with the root clamped
`trim`, `motions`           who carries the weight; phugoid and short period
`shapes`                    mode shapes, and the motion at flutter
`energy`                    the work of the air on segments and modes at flutter
`loads`                     pressure and circulation at flutter
`steady`                    circulation of a steady wing
`determinant`               zero lines of the determinant
`convergence`               airspeeds against the fineness of the computation
`flight`                    flight paths of a rigid aircraft
`flight_modes`              its eigenvalues, in the plane and against airspeed
`section`                   flutter speed and frequency of a section against its torsion frequency
`catalogue`                 which of these a dataset has
`layout`, `palette`         what they share: labels, ranges, colours by role
`branches`, `bodies`        lines against airspeed; centres of mass
`placing`                   where a text covers least
`level_flight`              where an aircraft cannot fly level
`events`                    how flutter points look, the same everywhere
`static`, `static_scenes`   matplotlib: PNG and SVG
`interactive`, ..._scenes   plotly: JSON data
`report`                    one HTML file with everything
==========================  ===================================================================
"""

from foldwing.plots.output import (
    interactive_figures,
    static_figures,
    write_animation,
    write_pictures,
    write_report,
)

__all__ = [
    "interactive_figures",
    "static_figures",
    "write_animation",
    "write_pictures",
    "write_report",
]
