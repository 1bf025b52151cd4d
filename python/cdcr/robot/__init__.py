"""Robots described: sections, cables, what acts on them, and their files."""
