"""BobDesk: from the plan of a bobsleigh track to a 3D centreline for simulation."""

__version__ = "0.1.0"

APPLICATION_ID = "io.github.bobdesk.BobDesk"
"""By which a desktop knows the program: its entry in the menu, its icon, its bundle. See packaging/identity.py."""
