"""Small worlds shared by tests, benchmarks and demos."""
