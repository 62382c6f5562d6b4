"""Modules of tools/verification-page: records of the tests, texts and figures of the rows, docs/verification.md."""
