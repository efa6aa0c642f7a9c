"""Studies: a wing and a grid of cases in, a labelled dataset out.

===========  ==================================================================================
`grid`       ranges, fold angles and speeds as a grid of cases
`speeds`     airspeeds when the user names none
`case`       one wing at given fold angles, solved
`modes`      natural frequencies and shapes
`flutter`    eigenvalues against airspeed and flutter points of one case
`boundary`   flutter points against fold angle
`trace`      the boundary as continuous curves
`aircraft`   an aircraft in flight beside its wing clamped; `flight_level` its level flight
`multibody`  one aircraft as joined bodies and as four states
`section`    a typical section against torsion frequency; `section_curves`, `lowest` its curves
`loads`      pressure, circulation and work of the air at flutter points
`steady`     steady lift, drag and moments against fold angle
`flight`     phugoid and short period of a rigid aircraft
`shapes`     points at which motions are drawn
`measured`   measured points to lay over a picture
`answers`    the same results as plain numbers, for JSON
===========  ==================================================================================
"""
