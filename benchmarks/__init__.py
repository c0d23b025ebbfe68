"""Measurements: `python -m benchmarks` compares with the peers, `python -m benchmarks.flat_regions` tests a claim."""
