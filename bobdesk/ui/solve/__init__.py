"""Parts of the panels Solve and Export."""
