"""Plan and gradients become a 3D centreline, its figures and comparisons."""
