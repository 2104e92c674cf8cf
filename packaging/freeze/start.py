"""What the frozen program runs first."""

import os
import sys

# So that it finds its own libraries, the frozen program was started with their folder in this variable. Other
# programs that it starts, such as the browser, need their own libraries, not these.
if sys.platform == "linux":
    before = os.environ.pop("LD_LIBRARY_PATH_ORIG", None)
    if before is None:
        os.environ.pop("LD_LIBRARY_PATH", None)
    else:
        os.environ["LD_LIBRARY_PATH"] = before

from bobdesk.__main__ import main

sys.exit(main())
