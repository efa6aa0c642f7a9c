"""Aerodynamics: unsteady forces as a function of p alone, and the steady lattice."""
