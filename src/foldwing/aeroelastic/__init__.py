"""Structure and aerodynamics joined, once, into T(p; U)."""
