"""How long a call takes."""

import statistics
import time
from collections.abc import Callable


def median_time(run: Callable[[], object], repeats: int = 7) -> float:
    """Return the median wall time of a call in seconds, after one that does not count."""
    run()
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        run()
        times.append(time.perf_counter() - start)
    return statistics.median(times)
