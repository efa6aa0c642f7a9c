"""Stability solvers for matrix functions T(p; U). Nothing in here knows of wings."""
