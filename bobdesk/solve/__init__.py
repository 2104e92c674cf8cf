"""Targets and limits become the gradient of every segment."""
