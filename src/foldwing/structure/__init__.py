"""Structural dynamics: component modes of the segments, hinges, and the joined wing.

====================  ==========================================================================
`component`           what every kind of segment model offers
`in_plane`            motions of a segment in its plane
`spanwise`            functions along the span from which the modes of a beam are made
`beam`                component modes of a beam segment
`plate`               component modes of a plate segment of any outline, by finite elements:
                      `plate_mesh`, `plate_elements`, `plate_elastic`; `plate_cache` keeps them
`sections`            plunge and twist of sections that bend along the chord
`mode_files`          modes of other programs and of tests: files and what they hold
`rigid_properties`    mass, centre and moments of inertia of a segment
`imported_selection`  which modes and points of a file a segment takes
`imported_doubts`     what speaks against them
`imported`            component modes of a segment from imported modes
`kinds`               which of these a segment has
`hinges`              springs and constraints between segments
`bodies`              fuselage and tail, rigid at the root
`assembly`            mass, stiffness and constraints of the joined wing
`modes`               its natural modes; those of an aircraft as a whole
`mass_centres`        centres of mass, and how the modes move them
`following`           modes followed through fold angles
====================  ==========================================================================
"""
