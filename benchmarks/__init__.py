"""Measurements: `python -m benchmarks` compares with the peers, the other modules measure a page's subject each."""
