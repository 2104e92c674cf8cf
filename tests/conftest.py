"""The program calculates with one thread; so do the tests, whose digits are compared with its processes'."""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
