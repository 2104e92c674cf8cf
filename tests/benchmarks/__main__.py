"""All benchmarks: `make benchmark`. They print tables and assert nothing."""

from __future__ import annotations

from tests.benchmarks import canvas, segments, solvers, tracing
from tests.benchmarks.measure import print_table


def main() -> None:
    """Run one after the other."""
    solvers.main()
    print_table("Tracing a drawn line, beside scikit-image's path on the same cost", tracing.rows())
    print_table("Frames of a 12000 × 8400 picture, ms of processor", canvas.rows())
    print_table("A boundary is dragged: ms of processor a frame", segments.rows())


if __name__ == "__main__":
    main()
