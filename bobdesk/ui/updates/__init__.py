"""Whether there is a newer version: asked only when the user wants it, and told, never fetched."""
