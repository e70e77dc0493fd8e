"""Where walkers go: when they arrive from where, what pulls them aside, and the way. Experimental: names may change."""
