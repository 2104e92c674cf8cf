"""All benchmarks: `make benchmark`. They print tables and assert nothing."""

from __future__ import annotations

from tests.benchmarks import solvers


def main() -> None:
    """Run one after the other."""
    solvers.main()


if __name__ == "__main__":
    main()
