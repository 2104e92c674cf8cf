"""All benchmarks: `make benchmark`. They print tables and assert nothing."""

from __future__ import annotations

from tests.benchmarks import solvers, tracing
from tests.benchmarks.measure import print_table


def main() -> None:
    """Run one after the other."""
    solvers.main()
    print_table("Tracing a drawn line, beside scikit-image's path on the same cost", tracing.rows())


if __name__ == "__main__":
    main()
