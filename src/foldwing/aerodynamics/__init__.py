"""Aerodynamics: every unsteady model gives generalized forces as a function of p alone.

==============  ================================================================================
`port`          what every model offers: Qhat(p) with F = U^2 Qhat(p) q
`strip`         Theodorsen's strip theory, quasi-steady theory
`combined`      the sum of several models: a wing of one kind, a tail of another
`horseshoe`     velocity of a horseshoe vortex: any in space, and many across the stream
`lattice`       strips and panels of the folded wing
`doubts`        when a lattice is refused or doubtful
`influence`     every vortex of the wing and its wake on every collocation point
`wake`          circulation in the rows of the wake
`unsteady`      the unsteady lattice as a transfer function
`schemes`       discrete time derivatives, for comparison
`rational`      one rational function in place of any model
`panel_loads`   circulation, pressure and force of every panel
`panels`        panels in space: strips, swept and tapered wings
`steady`        circulation for a given wash
`trefftz`       induced drag far downstream, and the least that a shape allows
`steady_loads`  lift, drag and moments of a folded wing and its segments
==============  ================================================================================
"""
