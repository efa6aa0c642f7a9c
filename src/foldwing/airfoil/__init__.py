"""The typical section: an airfoil on springs in Theodorsen's flow.

==========  ==========================================================
`matrices`  the equations of motion, from energy and virtual work
`system`    the section as a stability problem T(p; U)
==========  ==========================================================
"""
