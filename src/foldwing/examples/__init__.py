"""Model files shipped with the package, one per real case, and measurements to compare with."""
