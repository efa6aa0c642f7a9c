"""What a hopeless case may raise: it becomes part of the result, and the other cases stand."""

import numpy as np

from foldwing.errors import FoldwingError

NUMERICAL_FAILURES = (ArithmeticError, np.linalg.LinAlgError, ValueError, FoldwingError)
