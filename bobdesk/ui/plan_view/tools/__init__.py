"""What the hand does on the plan: one tool a file."""
