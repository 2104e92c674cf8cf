"""Start BobDesk: `python -m bobdesk`, the console script, and the frozen program come in here."""

from __future__ import annotations

import os
import sys


def main() -> int:
    """Run the command in `sys.argv` and return its exit status."""
    # Window, command and workers give the same digits; the matrices are too small for threads to pay.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    if sys.argv[1:2] == ["--picture-worker"]:
        # A frozen program has no Python to start its helper process with: it starts itself.
        from bobdesk.files.picture_worker import main as decode

        return decode()
    if sys.argv[1:2] == ["--dxf-worker"]:
        from bobdesk.files.importers.dxf_worker import main as read_drawing

        return read_drawing()
    if getattr(sys, "frozen", False):
        # The processes of a study are started in the same way; this does nothing in others.
        from multiprocessing import freeze_support

        freeze_support()
    from bobdesk.cli.main import run

    return run(sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
