"""Modules of tools/reproduce-paper: models, runs, exact answers, figures and the sections of docs/paper.md."""
