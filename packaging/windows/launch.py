"""What the programs for Windows run inside Python; installed into the folder "runtime"."""

import io
import sys


def main() -> int:
    """Run the program; what it says while it has no console is shown in a box when it fails."""
    # BobDesk.exe starts itself for its helper processes, as a frozen program does.
    sys.frozen = True
    unheard = None
    if sys.stdout is None:
        sys.stdout = io.StringIO()
    if sys.stderr is None:
        sys.stderr = unheard = io.StringIO()
    # Nobody sits before a helper process or a self-test: a box would keep them from ending.
    unattended = sys.argv[1:2] and (sys.argv[1].startswith("--") or sys.argv[1] == "selftest")
    status = 1
    try:
        from bobdesk.__main__ import main as bobdesk

        status = bobdesk()
    except Exception:  # noqa: BLE001 - whatever it is, it must be seen
        import traceback

        traceback.print_exc()
    if status and unheard is not None and not unattended:
        show(unheard.getvalue())
    return status


def show(said: str) -> None:
    """Show a sentence in a box, or the end of a long text."""
    import ctypes

    icon_error = 0x10
    ctypes.windll.user32.MessageBoxW(None, said.strip()[-1500:] or "BobDesk could not start.", "BobDesk", icon_error)


if __name__ == "__main__":
    sys.exit(main())
