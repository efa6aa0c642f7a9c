"""Flutter and divergence of folding wings.

The pipeline, in the order in which a wing passes through it:

================  =============================================================================
`model`           what the user describes: segments, hinges, point masses, aircraft, air
`structure`       component modes of the segments, joined at the hinges: natural modes
`aerodynamics`    unsteady forces on the modes as a function of p = lambda b / U
`aeroelastic`     both joined: T(p; U) x = 0
`airfoil`         the typical section, beside the wing
`flight`          longitudinal flight of a rigid aircraft, beside the wing
`simulation`      motions in time, and what can be identified in them
`stability`       eigenvalues, flutter points, boundaries of any T(p; U)
`studies`         a case or a grid of cases, to a labelled dataset
`results`         the dataset: schema, files, provenance
`plots`           pictures of a dataset
`cli`             the command line
================  =============================================================================

Axes, signs and reduced variables are in `foldwing.conventions`.
"""
