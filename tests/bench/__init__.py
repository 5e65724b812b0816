"""Benchmarks: `python -m tests.bench`. Ratios are measured interleaved in one run; nothing here is a test."""
