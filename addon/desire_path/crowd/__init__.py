"""Crowds that choose their ways, and the paths they leave. Experimental: names may change."""
