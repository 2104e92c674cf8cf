"""The result in space, drawn by a painter: the same on every screen, in files and without one."""
