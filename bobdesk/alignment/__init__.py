"""A polyline becomes equal stations, curvature, and straight and curved segments."""
