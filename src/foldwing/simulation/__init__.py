"""Motions in time: the reference marched from a disturbance, and what its response tells.

=================  =====================================================
`march`            the coupled equations, step by step
`identification`   damping and frequency from a response
=================  =====================================================
"""

from foldwing.simulation.identification import Identified, identify
from foldwing.simulation.march import Response, march

__all__ = ["Identified", "Response", "identify", "march"]
