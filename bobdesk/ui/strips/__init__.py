"""Strips by station under the plan: one axis, one cursor, any number of curves."""
