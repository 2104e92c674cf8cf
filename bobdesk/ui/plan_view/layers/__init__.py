"""What is drawn on the plan: one layer a file."""
