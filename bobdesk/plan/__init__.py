"""Pictures and coordinates become a polyline in metres."""
