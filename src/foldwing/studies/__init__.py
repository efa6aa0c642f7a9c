"""Studies: a wing and a grid of cases in, a labelled dataset out.

===========  ==================================================================================
`grid`       ranges, fold angles and speeds as a grid of cases
`modes`      natural frequencies and shapes
`flutter`    eigenvalues against airspeed and flutter points of one case
`boundary`   flutter points against fold angle
`measured`   measured points to lay over a picture
`answers`    the same results as plain numbers, for JSON
===========  ==================================================================================
"""
