"""The plan: picture, line and control points, and the tools that work on them."""
