"""Segments in the window: what is shown of them now, and what can be done to them."""
