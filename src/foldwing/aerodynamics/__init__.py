"""Unsteady aerodynamics: every model gives generalized forces as a function of p alone."""
