"""Where walkers go: when they arrive from where, what pulls them aside, their path. Experimental: names may change."""
