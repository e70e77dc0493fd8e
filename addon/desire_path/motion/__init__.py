"""Recordings of walkers: poses over time, and what can be told from them alone."""
