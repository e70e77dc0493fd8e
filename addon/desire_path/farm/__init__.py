"""One bake on many machines: a job of windows and tiles, its tasks, and what comes of them together. MODEL 13"""
