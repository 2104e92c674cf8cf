"""All benchmarks: `make benchmark`. They print tables and assert nothing."""

from __future__ import annotations

from tests.benchmarks import canvas, live_plots, openness, responsiveness, segments, solvers, steering, studies, tracing
from tests.benchmarks.measure import print_table


def main() -> None:
    """Run one after the other."""
    solvers.main()
    print_table("What the data leave open, 1,500 m on a grid of 10 m", openness.band_rows())
    print_table("Three known elevations, RMS of z in % of the drop", openness.advice_rows())
    print_table("Truth inside the 95 % bands of the error budget", openness.coverage_rows())
    print_table("A study", studies.rows())
    print_table("Tracing a drawn line, beside scikit-image's path on the same cost", tracing.rows())
    print_table("Frames of a 12000 × 8400 picture, ms of processor", canvas.rows())
    print_table("Lateness of a 5 ms timer of the window while work runs, ms", responsiveness.rows())
    live_plots.main()
    steering.main()
    print_table("A boundary is dragged: ms of processor a frame", segments.rows())


if __name__ == "__main__":
    main()
