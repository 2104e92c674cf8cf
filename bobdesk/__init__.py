"""BobDesk: from the plan of a bobsleigh track to a 3D centreline for simulation."""

__version__ = "0.1.0"
