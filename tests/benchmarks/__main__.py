"""All benchmarks: `make benchmark`. They print tables and assert nothing."""

from __future__ import annotations

from tests.benchmarks import canvas, live_plots, solvers, tracing
from tests.benchmarks.measure import print_table


def main() -> None:
    """Run one after the other."""
    solvers.main()
    print_table("Tracing a drawn line, beside scikit-image's path on the same cost", tracing.rows())
    print_table("Frames of a 12000 × 8400 picture, ms of processor", canvas.rows())
    live_plots.main()


if __name__ == "__main__":
    main()
