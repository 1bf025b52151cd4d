"""Runs through time: what drives them, what they return, and how they are stored."""
