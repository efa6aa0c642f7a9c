"""Structure and aerodynamics joined, once, into T(p; U).

===================  ===========================================================================
`wing`               a wing with everything that a sweep of fold angles shares
`system`             T(p; U) x = 0: modes, damping, neutral motions
`trim`               level flight: how much lift each segment and the tail carry
`aircraft`           the tail, and the forces that the steady lift adds in motion
`flight_modes`       phugoid and short period: found, followed, told from elastic roots
`rigid`              the rigid aircraft within the flexible one
`loads`              pressure, circulation and work of the air in a motion
`reference`          the same marched in time: every vortex of the wake is a state
`reference_roots`    its eigenvalues near a shift
`reference_loci`     its modes followed in airspeed
`reference_flutter`  where they cross the stability boundary
===================  ===========================================================================
"""
