"""Drawings by station."""
