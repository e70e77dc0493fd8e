"""Where a recording is taken to: its cycle along a path, many times, feet on the ground and in the prints."""
