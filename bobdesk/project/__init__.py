"""A project is a value: what the user decided, what follows from it, and each thing that can be done to it."""
