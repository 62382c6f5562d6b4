"""Modules of tools/bench: the programs that are measured, scenes, comparisons of two builds, and examples."""
