"""Structure and aerodynamics joined, once, into T(p; U).

===================  ===========================================================================
`wing`               a wing with everything that a sweep of fold angles shares
`system`             T(p; U) x = 0: modes, damping, neutral motions
`loads`              pressure, circulation and work of the air in a motion
`reference`          the same marched in time: every vortex of the wake is a state
`reference_roots`    its eigenvalues near a shift
`reference_loci`     its modes followed in airspeed
`reference_flutter`  where they cross the stability boundary
===================  ===========================================================================
"""
