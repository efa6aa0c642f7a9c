"""One thread per worker, no windows, and the same random examples in every run."""

import os

from hypothesis import settings

for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(variable, "1")  # read when numpy is first imported
os.environ.setdefault("MPLBACKEND", "Agg")
os.environ.setdefault("FOLDWING_CACHE", "")  # no test reads or fills the cache of a user

settings.register_profile("repeatable", deadline=None, derandomize=True)
settings.register_profile("explore", deadline=None, max_examples=1000, print_blob=True)
settings.load_profile("repeatable")
