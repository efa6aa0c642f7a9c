"""Stability solvers for matrix functions T(p; U). Nothing in here knows of wings.

=======================  ======================================================================
`problem`, `status`      what a solver sees, and what every solver returns
`newton`                 roots and flutter points by bordered Newton, many at once
`path`                   inverse speeds along a path of p, for every airspeed at once
`region`                 the contour around all unstable roots
`crossings`              where branches cross the stability boundary
`certificate`            unstable roots counted by the argument principle
`sweep`                  all crossings of all airspeeds, certified
`real_axis`              divergence, mergers, births of pairs
`still_air`, `tracking`, roots at rest; eigenvalues against airspeed
`loci`
`branches`, `flutter`    which points are one root and from which mode; the result of a case
`continuation`           the boundary through a parameter, around its turns
`domains`, `spectrum`,   all roots of any matrix function in a region, certified
`rootfinding`
`contours`               determinant contours
`pk`, `vg`, `classical`  the methods of the industry, for comparison
=======================  ======================================================================
"""
